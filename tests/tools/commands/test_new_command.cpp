#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "tests/tools/program.hpp"
#include "tools/scene/read_scene.hpp"

namespace test_new_command
{

using namespace tamp::test;
namespace fs = std::filesystem;

namespace
{

using Choice = std::array<std::string, 2>;  // kind and geometry

const std::vector<Choice> all_scenes{{"ball", "axisymmetric"},    {"ball", "plane"},         {"ball", "space"},
                                     {"punch", "plane"},          {"punch", "axisymmetric"}, {"punch", "space"},
                                     {"cone", "axisymmetric"},    {"cone", "space"},         {"footing", "plane"},
                                     {"footing", "axisymmetric"}, {"footing", "space"}};

fs::path shipped(const Choice& choice)
{
  return fmt::format("{}/tools/commands/new_scenes/{}_{}.json", TAMP_SOURCE_DIR, choice[0], choice[1]);
}

Outcome new_scene(const Choice& choice, const fs::path& out)
{
  return tamp_with(fmt::format("new {} {} --in {}", choice[0], out.string(), choice[1]));
}

}  // namespace

TEST_CASE("every kind of new scene is written as it was made, in all of its geometries and in no other")
{
  const TemporaryFolder folder;
  std::set<fs::path> written;
  for (const Choice& choice : all_scenes) {
    const fs::path out = folder.path() / (choice[0] + choice[1] + ".json");
    INFO(out);
    CHECK(new_scene(choice, out).exit_code == 0);
    CHECK(read_text(out) == read_text(shipped(choice)));
    written.insert(shipped(choice).filename());
  }

  std::set<fs::path> made;
  for (const auto& file : fs::directory_iterator(TAMP_SOURCE_DIR "/tools/commands/new_scenes")) {
    made.insert(file.path().filename());
  }
  CHECK(written == made);
}

TEST_CASE("every new scene is sound, needs no other file, and passes the check without a word where it is no space",
          "[slow]")
{
  for (const Choice& choice : all_scenes) {
    const auto checked = tamp::tools::read_scene(shipped(choice));
    const Outcome outcome = tamp_with("check --no-trial " + shipped(choice).string());

    INFO(shipped(choice));
    CHECK(checked.inputs.size() == 1);
    CHECK(checked.scene.grid.dimension == (choice[1] == "space" ? 3 : 2));
    CHECK(checked.scene.axisymmetric == (choice[1] == "axisymmetric"));
    CHECK(outcome.exit_code == 0);
    if (choice[1] != "space") CHECK_THAT(outcome.out, !Catch::Contains("warning"));
  }
}

TEST_CASE("a new scene runs, and its history has the columns that the command names", "[slow]")
{
  const TemporaryFolder folder;
  for (const Choice& choice : all_scenes) {
    const fs::path scene = folder.path() / (choice[0] + choice[1] + ".json"), run = folder.path() / scene.stem();
    const Outcome made = new_scene(choice, scene);
    const Outcome outcome = tamp_with(fmt::format("run {} --steps 3 --quiet --out {}", scene.string(), run.string()));

    INFO(scene);
    CHECK(outcome.exit_code == 0);
    const std::string force = fmt::format("{}.contact_force_{}[N]", choice[0], choice[1] == "space" ? "z" : "y");
    const std::string history = read_text(run / "history.csv"), names = history.substr(0, history.find('\n'));
    for (const std::string& column : {std::string("time[s]"), choice[0] + ".depth[m]", force}) {
      CHECK_THAT(names, Catch::Contains(column));
      CHECK_THAT(made.out, Catch::Contains(column));
    }
    CHECK_THAT(made.out, Catch::StartsWith(scene.string() + "\n") && Catch::Contains("tamp check " + scene.string()) &&
                             Catch::Contains("tamp run " + scene.string()) &&
                             Catch::Contains("tamp plot " + (fs::path("runs") / scene.stem()).string() + " "));
  }
}

TEST_CASE("without a geometry a ball and a cone are axisymmetric, a punch and a footing in the plane")
{
  const TemporaryFolder folder;
  for (const Choice& usual : {Choice{"ball", "axisymmetric"}, Choice{"punch", "plane"}, Choice{"cone", "axisymmetric"},
                              Choice{"footing", "plane"}}) {
    const fs::path out = folder.path() / (usual[0] + ".json");
    REQUIRE(tamp_with("new " + usual[0] + " " + out.string()).exit_code == 0);
    CHECK(read_text(out) == read_text(shipped(usual)));
  }
}

TEST_CASE("what is there already is not replaced by a new scene")
{
  const TemporaryFolder folder;
  const std::string file = folder.write("ball.json", "mine").string(), link = (folder.path() / "link.json").string();
  fs::create_symlink(folder.path() / "nowhere.json", link);

  for (const std::string& there : {file, link, folder.path().string()}) {
    const Outcome outcome = tamp_with("new ball " + there);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "tamp: " + there + ": already exists; expected the name of a new file\n");
  }
  CHECK(read_text(file) == "mine");
  CHECK_FALSE(fs::exists(folder.path() / "nowhere.json"));
}

TEST_CASE("a new scene of an unknown kind or geometry, or in no name, is refused with what there is")
{
  const TemporaryFolder folder;
  const std::string out = (folder.path() / "scene.json").string();
  const std::vector<std::array<std::string, 2>> all{
      {"bal " + out, "KIND: bal; did you mean ball?"},
      {"projectile " + out, "KIND: projectile; expected ball or punch or cone or footing"},
      {"ball " + out + " --in spce", "--in: spce; did you mean space?"},
      {"cone " + out + " --in plane", "--in: plane, where there is no cone; expected axisymmetric or space"},
      {"ball ''", "OUT: nothing; expected a name"},
      {"ball", "OUT is required; see tamp help new"}};
  for (const auto& [arguments, said] : all) {
    const Outcome outcome = tamp_with("new " + arguments);
    INFO(arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK(outcome.err == "tamp: " + said + "\n");
  }
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("a new scene in a folder that is not there ends with 4")
{
  const TemporaryFolder folder;

  CHECK(tamp_with("new ball " + (folder.path() / "none" / "ball.json").string()).exit_code == 4);
}

}  // namespace test_new_command
