#include <algorithm>
#include <catch2/catch.hpp>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/keys/schema.hpp"
#include "tools/scene/materials/read_material.hpp"

namespace test_old_words
{

using namespace tamp;
using namespace tamp::test;

namespace
{

using Lines = std::vector<std::string>;

/// The small scene, with sand from a file and a few keys more.
std::string scene_with(const std::string& sand, const std::string& keys)
{
  std::string scene = small_scene;
  scene.replace(scene.find("\"steel\": {"), 0, R"("sand": { "file": "sand.json" )" + sand + "}, ");
  scene.replace(scene.find("\"dimension\""), 0, keys);
  return scene;
}

/// Puts a key into the file of the sand.
void write_sand_with(const TemporaryFolder& folder, const std::string& key)
{
  write_sand(folder);
  std::string sand = read_text(folder.path() / "sand.json");
  sand.replace(sand.find("\"type\""), 0, key);
  folder.write("sand.json", sand);
}

bool separates(const tasks::SceneMaterial& material)
{
  return std::get<components::TabularCap>(material.model).may_separate();
}

}  // namespace

TEST_CASE("old words in a scene and in its files mean what the new ones do, and are noted with their places")
{
  const TemporaryFolder folder;
  write_sand_with(folder, R"("comes_apart": true, )");
  const auto file =
      folder.write("scene.json", scene_with("", R"("relief": "f_bar", "transfer": "affine", "gravity": [0, -1], )"));
  const std::string scene = file.string(), sand = (folder.path() / "sand.json").string();

  const auto checked = tools::read_scene(file);

  CHECK(checked.scene.anti_locking == tasks::AntiLocking::f_bar);
  CHECK(checked.scene.transfer == tasks::Transfer("tflip"));
  CHECK(separates(checked.scene.materials.at(0)));
  CHECK(checked.notes == Lines{scene + "#/relief: \"relief\" is now \"anti_locking\"",
                               scene + "#/transfer: \"affine\" is now \"tflip\"",
                               sand + "#/comes_apart: \"comes_apart\" is now \"separation\""});
  CHECK(checked.resolved["anti_locking"] == "f_bar");
  CHECK(checked.resolved["transfer"] == "tflip");
  CHECK(checked.resolved["materials"]["sand"]["separation"] == true);
  for (const char* old : {"relief", "comes_apart", "affine"})
    CHECK(tools::printed(checked.resolved).find(old) == std::string::npos);
}

TEST_CASE("new words are read without a note")
{
  const TemporaryFolder folder;
  write_sand(folder);
  const auto file = folder.write(
      "scene.json", scene_with(R"(, "separation": true)", R"("anti_locking": "f_bar", "transfer": "tflip", )"));

  CHECK(tools::read_scene(file, {"/anti_locking=none"}).notes.empty());
}

TEST_CASE("an assignment by an old word overrides the new one in a file, and the other way round")
{
  const TemporaryFolder folder;
  write_sand_with(folder, R"("separation": true, )");
  const auto new_words = folder.write("new.json", scene_with("", R"("anti_locking": "none", "transfer": "tflip", )"));
  const auto old_words =
      folder.write("old.json", scene_with(R"(, "comes_apart": false)", R"("relief": "none", "transfer": "affine", )"));

  const auto by_old =
      tools::read_scene(new_words, {"/relief=cell_average", "/transfer=affine", "/materials/sand/comes_apart=false"});
  const auto by_new = tools::read_scene(old_words, {"/anti_locking=cell_average", "/materials/sand/separation=true"});

  CHECK(by_old.scene.anti_locking == tasks::AntiLocking::cell_average);
  CHECK_FALSE(separates(by_old.scene.materials.at(0)));
  CHECK(by_old.notes == Lines{"--set#/relief: \"relief\" is now \"anti_locking\"",
                              "--set#/transfer: \"affine\" is now \"tflip\"",
                              "--set#/materials/sand/comes_apart: \"comes_apart\" is now \"separation\""});
  CHECK(by_new.scene.anti_locking == tasks::AntiLocking::cell_average);
  CHECK(separates(by_new.scene.materials.at(0)));
  CHECK(by_new.notes.size() == 3);
}

TEST_CASE("what is wrong with the value of an old word is reported at the old word's place")
{
  const TemporaryFolder folder;
  write_sand_with(folder, R"("comes_apart": "perhaps", )");
  const auto file = folder.write("scene.json", scene_with("", R"("relief": "volumetric", )"));

  CHECK(problems_of(folder, file) ==
        "scene.json#/relief: \"volumetric\"; expected one of none, cell_average, f_bar\n"
        "sand.json#/comes_apart: \"perhaps\"; expected true or false");
  CHECK(problems_of(folder, file, {"/relief=f_bar", "/materials/sand/comes_apart=1"}) ==
        "--set#/materials/sand/comes_apart: 1; expected true or false");
}

TEST_CASE("a key that a file has under both its names is given twice")
{
  const TemporaryFolder folder;
  write_sand(folder);
  const auto file = folder.write("scene.json", scene_with("", R"("relief": "f_bar", "anti_locking": "f_bar", )"));

  CHECK(problems_of(folder, file) ==
        "scene.json#/relief: the key is given twice, as \"anti_locking\" too; expected it once");
}

TEST_CASE("a name that the user chose may be an old word")
{
  const TemporaryFolder folder;
  std::string scene = small_scene;
  for (std::size_t at = scene.find("steel"); at != std::string::npos; at = scene.find("steel")) {
    scene.replace(at, 5, "relief");
  }

  const auto checked = tools::read_scene(folder.write("scene.json", scene));

  CHECK(checked.notes.empty());
  CHECK(checked.scene.materials.at(0).name == "relief");
}

TEST_CASE("a material's file by itself is read with old words, with a note")
{
  const TemporaryFolder folder;
  write_sand_with(folder, R"("comes_apart": true, )");
  const auto file = folder.path() / "sand.json";

  const auto in_file = tools::read_checked_material(file);
  const auto assigned = tools::read_checked_material(file, {"/comes_apart=false"});

  CHECK(separates(in_file.material));
  CHECK(in_file.notes == Lines{file.string() + "#/comes_apart: \"comes_apart\" is now \"separation\""});
  CHECK_FALSE(separates(assigned.material));
  CHECK(assigned.notes.size() == 2);
}

TEST_CASE("the program notes an old word once on stderr, and ends as without it")
{
  const TemporaryFolder folder;
  const std::string file = folder.write("scene.json", small_scene).string();
  const std::string run = " --set /time/end=1e-5 --quiet --strict --out " + (folder.path() / "run").string();
  const std::string note = "tamp: note: --set#/transfer: \"affine\" is now \"tflip\"\n";
  const auto n_notes = [](const Outcome& outcome) {
    int n = 0;
    for (std::size_t at = 0; (at = outcome.err.find("note: ", at)) != std::string::npos; ++at) ++n;
    return n;
  };

  const Outcome checked = tamp_with("check " + file + " --set /transfer=affine");
  const Outcome ran = tamp_with("run " + file + " --set /transfer=affine" + run);

  CHECK(checked.exit_code == 0);
  CHECK(checked.err.find(note) != std::string::npos);
  CHECK(n_notes(checked) == 1);
  CHECK(ran.exit_code == 0);
  CHECK(ran.err == note);
}

TEST_CASE("the schema has old keys and words beside those of now")
{
  const tools::Json schema = tools::scene_schema();
  const tools::Json& keys = schema.at("/definitions/scene/else/properties"_json_pointer);

  CHECK(keys.at("relief").at("enum") == keys.at("anti_locking").at("enum"));
  CHECK(keys.at("relief").at("description") == "now anti_locking");
  const tools::Json& words = keys.at("transfer").at("enum");
  CHECK(std::count(words.begin(), words.end(), "affine") == 1);
  CHECK(std::count(words.begin(), words.end(), "tflip") == 1);
}

}  // namespace test_old_words
