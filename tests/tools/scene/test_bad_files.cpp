#include <catch2/catch.hpp>

#include "tests/tools/scene/small_scene.hpp"

namespace test_bad_files
{

using namespace tamp::test;

namespace
{

/// The problems of the scene with sand when one of its tables holds this.
std::string problems_with_table(const std::string& table, const std::string& content)
{
  const TemporaryFolder folder;
  const auto scene = write_scene_with_sand(folder);
  folder.write("tables/" + table, content);
  return problems_of(folder, scene);
}

std::string problems_of_text(const std::string& text)
{
  const TemporaryFolder folder;
  return problems_of(folder, folder.write("scene.json", text));
}

}  // namespace

TEST_CASE("text that is not JSON is refused with line and column")
{
  CHECK_THAT(problems_of_text("{\n  \"dimension\": 2,,\n}"),
             Catch::StartsWith("scene.json:2:18: ") && Catch::EndsWith("; expected JSON"));
}

TEST_CASE("lines of a file are counted with those of comments, and so is a comment without an end")
{
  CHECK_THAT(problems_of_text("// a scene\n{\n  /* two\n  lines */ \"dimension\": 2,,\n}"),
             Catch::StartsWith("scene.json:4:27: ") && Catch::EndsWith("; expected JSON"));
  CHECK_THAT(problems_of_text("{\n  \"dimension\": 2 /* two\n}"),
             Catch::StartsWith("scene.json:3:") && Catch::Contains("missing closing '*/'"));
}

TEST_CASE("NaN is no JSON")
{
  CHECK_THAT(problems_of_text("{\"dimension\": NaN}"), Catch::StartsWith("scene.json:1:15: "));
}

TEST_CASE("a number too large for a double is refused")
{
  CHECK_THAT(problems_of_text("{\"dimension\": 1e999}"), Catch::StartsWith("scene.json") && Catch::Contains("1e999"));
}

TEST_CASE("a key that is given twice is refused with its place")
{
  CHECK(problems_of_text(R"({"list": [1, {"a": 1, "b": 2, "a": 3}]})") ==
        "scene.json#/list/1/a: the key is given twice; expected it once");
  CHECK(problems_of_text("{\"a\": 1, // \"a\"\n\"b\": 2, /* , */ \"a\": 3}") ==
        "scene.json#/a: the key is given twice; expected it once");
}

TEST_CASE("a scene that is no object is refused")
{
  CHECK(problems_of_text("[]") == "scene.json#: array; expected an object");
}

TEST_CASE("every key that a scene lacks is refused with its place")
{
  const std::string problems = problems_of_text("{}");
  CHECK_THAT(problems, Catch::Contains("scene.json#/dimension: missing; expected a whole number from 2 to 3"));
  CHECK_THAT(problems, Catch::Contains("scene.json#/grid: missing; expected an object"));
  CHECK_THAT(problems, Catch::Contains("scene.json#/materials: missing; expected an object"));
  CHECK_THAT(problems, Catch::Contains("scene.json#/bodies: missing; expected an object"));
}

TEST_CASE("a misspelt key is refused with the nearest known one")
{
  const TemporaryFolder folder;
  std::string scene = small_scene;
  scene.replace(scene.find("\"dimension\""), 0, "\"gravty\": [0, 0], ");

  CHECK(problems_of(folder, folder.write("scene.json", scene)) ==
        "scene.json#/gravty: unknown key; did you mean \"gravity\"?");
}

TEST_CASE("a problem in a material's file is refused with that file, and one in the scene with the scene")
{
  CHECK(problems_with_sand({"/materials/sand/density=0"}) ==
        "--set#/materials/sand/density: 0; expected a number above 0 [kg/m^3]");
  CHECK(problems_with_sand({"/materials/sand/poisson_ratio=null"}) ==
        "--set#/materials/sand/poisson_ratio: missing; expected a number above -1 and below 0.5");
  const TemporaryFolder folder;
  write_sand(folder);
  folder.write("sand.json", R"({"type":"tabular_cap","poisson_ratio":0.7})");
  std::string scene = small_scene;
  scene.replace(scene.find("\"steel\": {"), 0, R"("sand": { "file": "../sand.json", "density": -1 }, )");
  const std::string problems = problems_of(folder, folder.write("scenes/scene.json", scene));
  CHECK_THAT(problems, Catch::Contains("scenes/scene.json#/materials/sand/density: -1; expected"));
  CHECK_THAT(problems, Catch::Contains("\nsand.json#/poisson_ratio: 0.7; expected a number above -1 and below 0.5"));
  CHECK_THAT(problems, Catch::Contains("\nsand.json#/modulus: missing; expected an object"));
}

TEST_CASE("a missing file is refused with the path that was tried")
{
  CHECK(problems_with_sand({"/materials/sand/file=nothing.json"}) ==
        "--set#/materials/sand/file: there is no file nothing.json; expected the path of a JSON file\n"
        "scenes/scene.json#/materials/sand/type: missing; expected one of hypoelastic, neo_hookean, neo_hookean_log, "
        "drucker_prager, mohr_coulomb, bolton_sand, tabular_cap");
  CHECK(problems_with_sand({"/materials/sand/crush_curve=no.csv"}) ==
        "--set#/materials/sand/crush_curve: there is no file no.csv; expected the path of a file");
}

TEST_CASE("a table with other columns is refused with those that were expected")
{
  CHECK(problems_with_table("crush_curve.csv", "strain,pressure[Pa]\n0,1\n") ==
        "tables/crush_curve.csv:1: columns strain,pressure[Pa]; expected plastic_volumetric[-],pressure[Pa]");
}

TEST_CASE("rows of a table that are no numbers are refused with file and line")
{
  CHECK(
      problems_with_table("crush_curve.csv", "# c\nplastic_volumetric[-],pressure[Pa]\n0,1e6\n0.1\n0.2,nan\nx,1e7\n") ==
      "tables/crush_curve.csv:4: 1 values; expected 2\n"
      "tables/crush_curve.csv:5: \"nan\" for pressure[Pa]; expected a finite number\n"
      "tables/crush_curve.csv:6: \"x\" for plastic_volumetric[-]; expected a finite number");
}

TEST_CASE("an empty table is refused")
{
  CHECK(problems_with_table("crush_curve.csv", "# nothing\n") ==
        "tables/crush_curve.csv:1: no line with the names of the columns; expected plastic_volumetric[-],pressure[Pa]");
  CHECK(problems_with_table("crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n") ==
        "tables/crush_curve.csv:1: a table without rows; expected numbers");
}

TEST_CASE("a table whose numbers make no curve is refused with file and line")
{
  CHECK_THAT(problems_with_table("crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n0,1e6\n\n0.2,2e7\n0.1,3e7\n"),
             Catch::StartsWith("tables/crush_curve.csv:5: "));
  CHECK_THAT(problems_with_table("crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n0,1e6\n0.1,2e7\n0.2,1e7\n"),
             Catch::StartsWith("tables/crush_curve.csv:4: crush pressure"));
  CHECK_THAT(problems_with_table("yield.csv", "pressure[Pa],sqrt_J2[Pa]\n-1e4,5\n1e6,6e5\n"),
             Catch::StartsWith("tables/yield.csv:2: "));
  CHECK_THAT(problems_with_table("unloading.csv",
                                 "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
                                 "0.05,0,0\n0.05,0.005,5e6\n0.05,0.01,1e7\n0.04,0,0\n"),
             Catch::StartsWith("tables/unloading.csv:5: "));
}

}  // namespace test_bad_files
