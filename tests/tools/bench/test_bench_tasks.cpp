#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/program.hpp"

namespace test_bench_tasks
{

using namespace tamp::test;

TEST_CASE("the benchmark of tasks compares schedulers in one table and one file", "[slow]")
{
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "tasks.json").string();

  const Outcome outcome = tamp_with("bench --json " + file + " --rounds 1 --threads 1 tasks");

  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(file));
  std::set<std::string> schedulers;
  for (const auto& row : json.at("tasks")) {
    schedulers.insert(row.at("scheduler").get<std::string>());
    CHECK(row.at("threads") == 1);
    CHECK(row.contains("overhead_ns"));
    CHECK(row.contains("metg50_us"));
    CHECK(row.at("processor_ns") > 0);
    CHECK_THAT(outcome.out, Catch::Contains(row.at("scheduler").get<std::string>()));
  }
  CHECK(schedulers.count("tamp") == 1);
  CHECK(schedulers.count("tamp, declared") == 1);
  CHECK(schedulers.count("plain loop") == 1);
  CHECK(schedulers.count("tbb flow graph") == 1);
  CHECK(schedulers.count("tbb flow graph, lightweight") == 1);
}

TEST_CASE("on several ranks the benchmark of tasks compares the exchange of halos with plain MPI", "[mpiexec]")
{
  const int n_ranks = GENERATE(2, 3);
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "tasks.json").string();

  const Outcome outcome = tamp_on_ranks(n_ranks, "bench --json " + file + " --rounds 1 --message-bytes 256");

  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(file)).at("tasks");
  std::multiset<std::string> schedulers;
  for (const auto& row : json) {
    schedulers.insert(row.at("scheduler").get<std::string>());
    CHECK(row.at("ranks") == n_ranks);
    CHECK(row.at("threads") == 1);
    CHECK(row.at("message_bytes") == 256);
    CHECK(row.contains("overhead_ns"));
    CHECK(row.contains("metg50_us"));
  }
  CHECK(schedulers == std::multiset<std::string>{"plain MPI", "plain MPI", "tamp", "tamp"});
  CHECK_THAT(outcome.out, Catch::Contains("plain MPI"));
}

TEST_CASE("other benchmarks on several ranks are refused", "[mpiexec]")
{
  const Outcome outcome = tamp_on_ranks(2, "bench tasks punch");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("tamp: punch: started on several ranks; expected one, or"));
}

TEST_CASE("a message that is not made of whole values is refused")
{
  CHECK(tamp_with("bench tasks --message-bytes 1001").exit_code == 2);
  CHECK(tamp_with("bench tasks --message-bytes 0").exit_code == 2);
  CHECK(tamp_with("bench tasks --message-bytes many").exit_code == 2);
}

TEST_CASE("numbers of rounds and threads below one are refused")
{
  CHECK(tamp_with("bench tasks --rounds 0").exit_code == 2);
  CHECK(tamp_with("bench tasks --threads 1,0").exit_code == 2);
}

}  // namespace test_bench_tasks
