#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_verification
{

/// The shipped verification in its short form.
using namespace tamp::test;
using Json = nlohmann::json;

TEST_CASE("short verifications hold what they expect, and say which errors and orders they found", "[slow]")
{
  draw_no_pages();
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();

  const Outcome outcome = tamp_with("verify --short --quiet --out " + out + rehearsed);

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  const Json results = Json::parse(read_text(out + "/verification.json"));
  if (is_rehearsal) return;
  CHECK(results["failures"].empty());
  CHECK(results["held_misses"].empty());
  REQUIRE(results["studies"].size() > 20);
  for (const Json& study : results["studies"]) {
    INFO(study["name"]);
    CHECK_FALSE(study["gates"].empty());
    for (const Json& gate : study["gates"]) CHECK(gate["found"].is_number());
  }
}

TEST_CASE("every shipped verification says what has to hold, why, and in which short form")
{
  for (const auto& file : std::filesystem::directory_iterator(TAMP_SOURCE_DIR "/inputs/verification")) {
    if (file.path().extension() != ".json") continue;
    INFO(file.path());
    const Json study = Json::parse(read_text(file.path()));
    REQUIRE_FALSE(study.at("expect").empty());
    CHECK_FALSE(study.at("short").at("expect").empty());
    for (const Json& expected : study.at("expect")) CHECK_FALSE(expected["why"].get<std::string>().empty());
    for (const Json& quantity : study.at("quantities")) CHECK(quantity.contains("exact"));
  }
}

}  // namespace test_verification
