#include <sys/wait.h>

#include <catch2/catch.hpp>
#include <cstdio>
#include <fstream>
#include <memory>
#include <sstream>
#include <string>

#include "runtime/storage/temporary_folder.hpp"

namespace test_first_task_graph
{

namespace
{

std::string text_of(const std::string& path)
{
  std::ifstream file(std::string(TAMP_SOURCE_DIR) + "/docs/tutorials/" + path);
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
  CHECK(n_blocks == 12);
}

TEST_CASE("the program of the first task graph finds its order, restarts and is balanced on any ranks", "[mpiexec]")
{
  const tamp::runtime::TemporaryFolder folder;
  const std::string log = folder.path() / "log", arguments = " " + (folder.path() / "plate").string() + " 2> " + log;
  const auto log_has = [&](const std::string& words) {
    std::stringstream text;
    text << std::ifstream(log).rdbuf();
    return text.str().find(words) != std::string::npos;
  };

  const Run alone = run(TAMP_FIRST_TASK_GRAPH + arguments);

  CHECK(alone.status == 0);
  CHECK(alone.output.find("order 1.9") != std::string::npos);
  CHECK(log_has("diffuse"));
  CHECK_FALSE(log_has("dealt anew"));
  for (const char* n_ranks : {"2", "3"}) {
    const Run together = run(std::string("OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " TAMP_MPIEXEC
                                         " --oversubscribe --bind-to none -np ") +
                             n_ranks + " " TAMP_FIRST_TASK_GRAPH + arguments);
    CHECK(together.status == 0);
    CHECK(together.output == alone.output);
    CHECK(log_has("diffuse"));
    CHECK(log_has("dealt anew before step 20"));
  }
}

TEST_CASE("the program of the first task graph says in words what file it cannot have")
{
  const tamp::runtime::TemporaryFolder folder;
  const std::string log = folder.path() / "log", below_a_file = log + "/plate";

  const Run refused = run(TAMP_FIRST_TASK_GRAPH " " + below_a_file + " 2> " + log);

  CHECK(WIFEXITED(refused.status));
  CHECK(WEXITSTATUS(refused.status) == 1);
  std::stringstream text;
  text << std::ifstream(log).rdbuf();
  CHECK_THAT(text.str(), Catch::StartsWith(below_a_file));
}

}  // namespace test_first_task_graph
