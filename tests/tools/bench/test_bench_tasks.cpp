#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <set>

#include "tests/tools/program.hpp"

using namespace tamp::test;

TEST_CASE("the benchmark of tasks compares schedulers in one table and one file")
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
    CHECK_THAT(outcome.out, Catch::Contains(row.at("scheduler").get<std::string>()));
  }
  CHECK(schedulers.count("tamp") == 1);
  CHECK(schedulers.count("plain loop") == 1);
  CHECK(schedulers.count("tbb flow graph") == 1);
}

TEST_CASE("numbers of rounds and threads below one are refused")
{
  CHECK(tamp_with("bench tasks --rounds 0").exit_code == 2);
  CHECK(tamp_with("bench tasks --threads 1,0").exit_code == 2);
}
