#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"

namespace test_stability
{

/// The shipped failure catalogue.
using namespace tamp::test;
using Json = nlohmann::json;

TEST_CASE("every entry of the failure catalogue fails and survives as told, on any machine")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();

  const Outcome outcome = tamp_with("stability --quiet --out " + out);

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  const Json results = Json::parse(read_text(out + "/stability.json"));
  CHECK(results["failures"].empty());
  CHECK(results["entries"].size() >= 16);
}

TEST_CASE("every entry of the failure catalogue says in words what goes wrong and what to use instead")
{
  for (const auto& file : std::filesystem::directory_iterator(TAMP_SOURCE_DIR "/inputs/stability")) {
    if (file.path().extension() != ".json") continue;
    INFO(file.path());
    const Json entry = Json::parse(read_text(file.path()));
    CHECK(entry.at("title").get<std::string>().size() < 100);
    CHECK_FALSE(entry.at("about").get<std::string>().empty());
    CHECK_FALSE(entry.at("stability").at("symptom").get<std::string>().empty());
    CHECK(entry.at("repeat") == 1);
  }
}

}  // namespace test_stability
