#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

namespace test_first_task_graph
{

namespace
{

std::string text_of(const std::string& path)
{
  std::ifstream file(std::string(TAMP_SOURCE_DIR) + "/docs/" + path);
  std::stringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Run {
  std::string output;
  int status;
};

Run run(const std::string& command)
{
  FILE* const pipe = popen(command.c_str(), "r");
  REQUIRE(pipe != nullptr);
  std::string output;
  for (int c = std::fgetc(pipe); c != EOF; c = std::fgetc(pipe)) output += static_cast<char>(c);
  return {output, pclose(pipe)};
}

}  // namespace

TEST_CASE("the page on the first task graph shows lines of its program, and no others")
{
  const std::string page = text_of("first_task_graph.md"), program = text_of("first_task_graph/heat.cpp");
  const std::string fence = "```";
  int n_blocks = 0;
  for (std::size_t begin = page.find(fence + "cpp"); begin != std::string::npos;
       begin = page.find(fence + "cpp", begin)) {
    begin = page.find('\n', begin) + 1;
    const std::size_t end = page.find(fence, begin);
    CAPTURE(page.substr(begin, end - begin));
    CHECK(program.find(page.substr(begin, end - begin)) != std::string::npos);
    ++n_blocks;
  }
  CHECK(n_blocks == 7);
}

TEST_CASE("the program of the first task graph finds its order, and the same digits on three ranks", "[mpiexec]")
{
  const Run alone = run(TAMP_FIRST_TASK_GRAPH);
  const Run together = run("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " TAMP_MPIEXEC
                           " -np 3 --oversubscribe --bind-to none " TAMP_FIRST_TASK_GRAPH);

  CHECK(alone.status == 0);
  CHECK(together.status == 0);
  CHECK(alone.output.find("order 1.9") != std::string::npos);
  CHECK(together.output == alone.output);
}

}  // namespace test_first_task_graph
