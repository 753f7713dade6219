#include <catch2/catch.hpp>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "runtime/file_error.hpp"
#include "tests/tools/program.hpp"
#include "tools/run/page_data.hpp"

namespace test_page_data
{

using namespace tamp;
using namespace tamp::test;
namespace fs = std::filesystem;
using Json = nlohmann::json;

namespace
{

/// A steel block that falls on the plane y = 0 of a quarter of a tank, half full of rubber.
const char* const falling = R"({
  "dimension": 3,
  "grid": { "upper": [4, 2, 4], "cell_size": 0.5 },
  "boundaries": { "y+": "open", "z+": "open" },
  "time": { "end": 1 },
  "materials": {
    "steel": { "type": "hypoelastic", "density": 8000, "bulk_modulus": 1e7, "shear_modulus": 1e7 },
    "rubber": { "type": "hypoelastic", "density": 1000, "bulk_modulus": 1e6, "shear_modulus": 1e6 }
  },
  "bodies": {
    "block": {
      "material": "steel", "geometry": { "type": "box", "lower": [1, 0, 2.5], "upper": [2, 1, 3.5] },
      "velocity": [0, 0, -10]
    },
    "floor": { "material": "rubber", "geometry": { "type": "box", "lower": [0, 0, 0], "upper": [4, 2, 2] } }
  }
})";

fs::path run_of(const TemporaryFolder& folder, const std::string& options)
{
  const fs::path out = folder.path() / "run";
  REQUIRE(tamp_with("run " + options + " --quiet --out " + out.string()).exit_code == 0);
  return out;
}

Json page_of(const fs::path& run)
{
  tools::write_page_data(run);
  return Json::parse(read_text(run / "page.json"));
}

/// The value of a picture at a place in the plane.
Json at(const Json& picture, const char* what, double x, double y)
{
  const auto column = static_cast<std::size_t>(x / picture["size"].get<double>());
  const auto row = static_cast<std::size_t>(y / picture["size"].get<double>());
  return picture[what][row * picture["n"][0].get<std::size_t>() + column];
}

}  // namespace

TEST_CASE("pictures of a run show which material is where at its start and at its end, and how fast it is")
{
  const TemporaryFolder folder;

  const Json page = page_of(run_of(folder, TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 20"));

  CHECK(page["materials"] == Json{"steel", "sand"});
  REQUIRE(page["pictures"].size() == 2);
  const Json &first = page["pictures"][0], &last = page["pictures"][1];
  CHECK(first["time_s"] == 0);
  CHECK(last["time_s"].get<double>() > 0);
  CHECK(first["slab"].is_null());
  CHECK(at(first, "materials", 0.5, 0.6) == 0);
  CHECK(at(first, "materials", 0.5, 0.4) == 1);
  CHECK(at(first, "materials", 0.1, 0.7) == -1);
  CHECK(at(first, "speeds", 0.5, 0.6) == 200);
  CHECK(at(first, "speeds", 0.5, 0.4) == 0);
  CHECK(at(first, "speeds", 0.1, 0.7).is_null());
}

TEST_CASE("in space the plane of symmetry is shown on which a body moves or is driven, seen along it")
{
  const TemporaryFolder folder;
  const fs::path scene = folder.write("falling.json", falling);
  const std::string driven = R"( --set /bodies/block/driven='{"velocities": [[0, 0, 0, 0], [1, 0, 0, -1]]}')";
  const std::string at_rest = " --set /bodies/block/velocity=null --set /bodies/block/rigid=true" + driven;
  const std::string way = GENERATE_COPY(std::string(), at_rest);

  const Json page = page_of(run_of(folder, scene.string() + " --steps 1" + way));

  const Json& first = page["pictures"][0];
  CHECK(first["slab"] == Json{{"axis", "y"}, {"at", 0.0}});
  CHECK(first["axes"][0]["name"] == "x");
  CHECK(first["axes"][1]["name"] == "z");
  CHECK(at(first, "materials", 1.5, 3) == 0);
  CHECK(at(first, "materials", 3, 1) == 1);
}

TEST_CASE("a run without fields has no pictures, and one with a damaged file of fields has the reason in their place",
          "[slow]")
{
  const TemporaryFolder folder;
  const fs::path run = run_of(folder, TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 2");
  fs::rename(run / "fields.h5", run / "moved.h5");

  CHECK(page_of(run)["pictures"].empty());
  CHECK_FALSE(page_of(run).contains("no_pictures"));

  const std::string all = read_text(run / "moved.h5");
  const std::string damaged = GENERATE_COPY(std::string(), all.substr(0, all.size() / 3), std::string(4096, 'x'));
  folder.write("run/fields.h5", damaged);
  const Json page = page_of(run);
  CHECK(page["pictures"].empty());
  CHECK_THAT(page["no_pictures"].get<std::string>(), Catch::Contains("fields.h5: cannot"));
}

TEST_CASE("a damaged scene of a run is refused by its name", "[slow]")
{
  const TemporaryFolder folder;
  const fs::path run = run_of(folder, TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 2");
  folder.write("run/scene.json", GENERATE("", "{", "[]", "{\"materials\": 3}", "{\"materials\": {\"steel\": {}}}"));

  CHECK_THROWS_AS(page_of(run), runtime::FileError);
  CHECK_THROWS_WITH(page_of(run), Catch::Contains("scene.json: is damaged"));
}

TEST_CASE("a scene of a run whose domain or cells cannot be is refused by its name", "[slow]")
{
  const TemporaryFolder folder;
  const fs::path run = run_of(folder, TAMP_SOURCE_DIR "/inputs/punch/quick.json --steps 2");
  const Json change = GENERATE(Json{{"upper", {0, 0}}}, Json{{"upper", {1, -1}}}, Json{{"lower", {2, 2}}},
                               Json{{"cell_size", 0}}, Json{{"cell_size", 1e300}});
  Json scene = Json::parse(read_text(run / "scene.json"));
  scene["grid"].update(change);
  folder.write("run/scene.json", scene.dump());

  const Outcome page = tamp_with("profile --format html " + run.string());

  CHECK(page.exit_code == 4);
  CHECK_THAT(page.err, Catch::Contains("scene.json: is damaged"));
}

}  // namespace test_page_data
