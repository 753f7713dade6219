#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_lost_output
{

using namespace tamp::test;

TEST_CASE("a run whose table or fields are gone at its end says so, ends with 4, and has its summary", "[slow]")
{
  const auto [name, harm, found] =
      GENERATE(table<std::string, std::string, std::string>({{"history.csv", "rm", "was removed"},
                                                             {"history.csv", "cp /dev/null", "was changed"},
                                                             {"history.csv", "touch x; mv x", "was replaced"},
                                                             {"machine.csv", "rm", "was removed"},
                                                             {"fields.h5", "rm", "was removed"}}));
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();

  const Outcome outcome = outcome_of("sh -c 'cd " + folder.path().string() +
                                     "; " TAMP_PROGRAM " run " TAMP_SOURCE_DIR
                                     "/inputs/punch/quick.json --quiet --steps 200"
                                     " --set /output/fields_interval=1 --set /output/history_interval=1e-5 --out run &"
                                     " while [ $(cat run/history.csv 2>/dev/null | wc -l) -lt 3 ]; do sleep 0.01; done;"
                                     " " +
                                     harm + " run/" + name + "; wait $!'");

  INFO(name << " " << harm);
  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains(name + ": " + found + " by someone else"));
  const auto summary = nlohmann::json::parse(read_text(run + "/summary.json"));
  CHECK_THAT(summary.dump(), Catch::Contains(name + ": " + found));
  if (name == "history.csv" && found == "was changed") {
    CHECK_THAT(read_text(run + "/history.csv"), !Catch::Contains(std::string(1, '\0')));
  }
}

}  // namespace test_lost_output
