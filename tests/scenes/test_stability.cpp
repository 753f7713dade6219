#include <algorithm>
#include <catch2/catch.hpp>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_stability
{

/// The shipped failure catalogue.
using namespace tamp::test;
using Json = nlohmann::json;

namespace
{

/// The share of a monitor over its limit in the run of an entry that fails, or in that which survives.
double share_of_limit(const Json& entries, const std::string& monitor, const std::string& name, const char* run)
{
  const auto entry = std::find_if(entries.begin(), entries.end(), [&](const Json& e) { return e["name"] == name; });
  return entry->at(run)["shares_of_limits"][monitor];
}

}  // namespace

TEST_CASE("every entry of the failure catalogue fails and survives as told, on any machine", "[slow]")
{
  draw_no_pages();
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "out").string();

  const Outcome outcome = tamp_with("stability --quiet --out " + out + rehearsed);

  INFO(outcome.err);
  CHECK(outcome.exit_code == 0);
  const Json results = Json::parse(read_text(out + "/stability.json"));
  if (is_rehearsal) return;
  CHECK(results["failures"].empty());
  CHECK(results["entries"].size() >= 16);

  // Monitors warn in the run with the error that they are about, and not in its sound counterpart, with room on both
  // sides of the limit.
  const std::map<std::string, std::string> pairs{
      {"damped_energy", "local_damping"},        {"early_contact", "early_contact"},
      {"early_at_walls", "early_at_walls"},      {"energy_drift", "published_step"},
      {"filtered_energy", "isolated_particles"}, {"interpenetration", "catching_sides"},
      {"lost_mass", "cut_parallelograms"},       {"null_space", "null_space"},
      {"out_of_range", "beyond_the_tests"},      {"redone_steps", "viscosity_and_step"},
      {"swollen_load", "swelling_sand"},         {"torn_apart", "numerical_fracture"},
      {"uneven_pressure", "locking_beam"}};
  for (const auto& [monitor, entry] : pairs) {
    CAPTURE(monitor, entry);
    CHECK(share_of_limit(results["entries"], monitor, entry, "fails") > 1.5);
    CHECK(share_of_limit(results["entries"], monitor, entry, "survives") < 0.5);
  }
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
