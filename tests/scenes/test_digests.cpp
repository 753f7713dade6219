#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>

#include "tests/tools/program.hpp"
#include "tests/tools/rehearsal.hpp"

namespace test_digests
{

using namespace tamp::test;

namespace
{

// Pinned by tools/python/tamp digests --write: a digest has no answer beside the program's.
nlohmann::json committed_digests()
{
  return nlohmann::json::parse(std::ifstream(TAMP_SOURCE_DIR "/tests/scenes/digests.json"));
}

std::string digest_of(const std::string& scene, int n_steps)
{
  const TemporaryFolder folder;
  const std::string run = (folder.path() / "run").string();
  const Outcome outcome = tamp_with("run " TAMP_SOURCE_DIR "/inputs/" + scene + " --steps " + std::to_string(n_steps) +
                                    " --quiet --out " + run);
  REQUIRE(outcome.exit_code == 0);
  return nlohmann::json::parse(std::ifstream(run + "/summary.json"))["state_digest"];
}

void check_all_digests()
{
  const nlohmann::json committed = committed_digests();
  for (const auto& [scene, expected] : committed.items()) {
    INFO(scene);
    const std::string digest = digest_of(scene, n_steps_of(expected["steps"]));
    if (!is_rehearsal) CHECK(digest == expected["digest"]);
  }
}

}  // namespace

TEST_CASE("every shipped scene ends with its committed digest, whatever the processor and the compiler",
          "[scenes][slow][pinned]")
{
  check_all_digests();
}

TEST_CASE("digests do not depend on which functions the C library chooses for the processor", "[scenes][slow][pinned]")
{
  setenv("GLIBC_TUNABLES", "glibc.cpu.hwcaps=-FMA,-AVX2", 1);

  check_all_digests();

  unsetenv("GLIBC_TUNABLES");
}

TEST_CASE("every shipped scene has a committed digest", "[scenes]")
{
  const nlohmann::json committed = committed_digests();

  for (const std::string folder : {"balance", "cone", "footing", "punch", "uxo", "verification/axis_aligned",
                                   "verification/compacted_column", "verification/ring", "verification/vortex"}) {
    for (const auto& file : std::filesystem::directory_iterator(TAMP_SOURCE_DIR "/inputs/" + folder)) {
      if (file.path().extension() != ".json") continue;
      const auto json = nlohmann::json::parse(std::ifstream(file.path()));
      const bool is_scene = json.contains("grid") || json.contains("file");
      INFO(file.path());
      CHECK(committed.contains(folder + "/" + file.path().filename().string()) == is_scene);
    }
  }
}

}  // namespace test_digests
