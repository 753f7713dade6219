#include <fmt/format.h>

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/scene/small_models.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/advice/plausibility.hpp"

namespace test_compare_modulus
{

using namespace tamp;
using namespace tamp::test;
using Catch::Contains;
using nlohmann::json;

namespace
{

/// Runs the check of a sand whose tables have K = 1 GPa, with a network that has another K everywhere.
class SandWithNetwork
{
 public:
  SandWithNetwork()
  {
    scene_ = write_scene_with_sand(folder_);
    folder_.write("tables/unloading.csv",
                  "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
                  "0.05,0,0\n0.05,0.005,5e6\n0.05,0.01,1e7\n0.1,0,0\n0.1,0.005,5e6\n0.1,0.01,1e7\n");
    // Elastic strain X / 1 GPa all along the loading.
    folder_.write("tables/crush_curve.csv", "plastic_volumetric[-],pressure[Pa]\n0,1e6\n0.2,2.1e7\n");
    folder_.write("tables/hydrostat.csv", "total_volumetric[-],pressure[Pa]\n0,0\n0.001,1e6\n0.221,2.1e7\n");
    json sand = json::parse(read_text(folder_.path() / "sand.json"));
    sand["hydrostat"] = "tables/hydrostat.csv";
    sand["modulus"]["type"] = "mlp";
    sand["modulus"]["mlp"] = "network.h5";
    folder_.write("sand.json", sand.dump());
  }

  tools::CheckedScene with_modulus(double K, const std::vector<std::string>& assignments = {}) const
  {
    write_keras(folder_.path() / "network.h5", {.layers = {{"only", "linear", 2, 1, {0, 0}, {0}}},
                                                .scaling = {0.005, 0.005, 0.1, 0.1, K, 1},
                                                .range = {0, 0.02, 0, 0.3}});
    return tools::read_scene(scene_, assignments);
  }

  const TemporaryFolder& folder() const { return folder_; }

 private:
  TemporaryFolder folder_;
  std::filesystem::path scene_;
};

std::string warned(const tools::CheckedScene& scene)
{
  std::string text;
  for (const std::string& line : tools::plausibility_warnings(scene)) {
    if (line.find("/modulus: ") != std::string::npos) text += line;
  }
  return text;
}

}  // namespace

TEST_CASE("a network that is off from the unloading curves beside it is warned of from 3 times on, remarked from 1.3")
{
  const SandWithNetwork sand;

  const auto close = sand.with_modulus(1.2e9), off = sand.with_modulus(1.5e9), soft = sand.with_modulus(0.5e9);
  const auto far = sand.with_modulus(3.5e9), mega = sand.with_modulus(1e15), micro = sand.with_modulus(1e3);

  CHECK(close.remarks.empty());
  CHECK(warned(close).empty());
  REQUIRE(off.remarks.size() == 1);
  CHECK_THAT(off.remarks.front(),
             Catch::StartsWith("/materials/sand/modulus: \"mlp\" has 1.5 times the pressure of ") &&
                 Contains("unloading.csv: ") && Contains(" at elastic strain 0.0"));
  CHECK(warned(off).empty());
  REQUIRE(soft.remarks.size() == 1);
  CHECK_THAT(soft.remarks.front(), Contains("has 0.5 times the pressure"));
  CHECK(far.remarks.empty());
  CHECK_THAT(warned(far), Contains("has 3.5 times the pressure") &&
                              Contains("; likely other units, a scaling that is inverted or left out, or variances "
                                       "for deviations"));
  CHECK_THAT(warned(mega), Contains("; likely pressures in Pa that are read as MPa"));
  CHECK_THAT(warned(micro), Contains("; likely pressures in MPa that are read as Pa"));
}

TEST_CASE("without unloading curves a network is compared with the loading of its crush curve and hydrostat")
{
  const SandWithNetwork sand;
  const std::string no_curves = "/materials/sand/modulus/table=null";

  const auto close = sand.with_modulus(1.2e9, {no_curves}), far = sand.with_modulus(4e9, {no_curves});
  const auto alone = sand.with_modulus(4e9, {no_curves, "/materials/sand/hydrostat=null"});

  CHECK(close.remarks.empty());
  CHECK(warned(close).empty());
  CHECK_THAT(warned(far), Contains("has 4 times the pressure of the crush curve and the hydrostat: "));
  CHECK(alone.remarks.empty());
  CHECK(warned(alone).empty());
}

TEST_CASE("a compiled network is compared, a table is not, and curves that cannot be read are a remark")
{
  const SandWithNetwork sand;

  CHECK_THAT(warned(sand.with_modulus(4e9, {"/materials/sand/modulus/compile=1e-3"})), Contains("has 4 times"));
  CHECK(sand.with_modulus(4e9, {"/materials/sand/modulus/type=table"}).remarks.empty());
  const auto missing = sand.with_modulus(1e9, {"/materials/sand/modulus/table=none.csv"});
  REQUIRE(missing.remarks.size() == 1);
  CHECK_THAT(missing.remarks.front(),
             Contains("/materials/sand/modulus: not compared with its unloading curves: ") && Contains("none.csv"));
}

TEST_CASE("support vectors in other units than their tables are warned of, in either measure of strain")
{
  const TemporaryFolder folder;
  const auto scene = write_scene_with_sand(folder);
  folder.write("fit.json", small_regression);
  const std::vector<std::string> svr{"/materials/sand/modulus/type=svr",
                                     "/materials/sand/modulus/svr=" + (folder.path() / "fit.json").string()};
  const auto warned_of = [&](const std::string& measure, const std::string& key, const json& value) {
    json fit = json::parse(small_regression);
    if (!key.empty()) fit[key] = value;
    folder.write("fit.json", fit.dump());
    std::vector<std::string> assignments = svr;
    assignments.push_back("/materials/sand/strain_measure=" + measure);
    return warned(tools::read_scene(scene, assignments));
  };
  for (const std::string measure : {"logarithmic", "engineering"}) {
    INFO(measure);
    // The fit's own pressures, by its formula: K about 1.3 GPa.
    std::string curves = "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n";
    for (const double plastic : {0.05, 0.1}) {
      const auto pressure = [&](double elastic) {
        const double x = (100 * (elastic + plastic) + 10) * 0.02, y = 100 * plastic * 0.04;
        double sum = 0;
        for (const auto& [a, s, t] : {std::array{1.0, 1.2, 0.0}, {0.5, 1.1, 1.0}, {-0.25, -0.1, 0.5}}) {
          sum += a * std::exp(-0.5 * ((s - x) * (s - x) + (t - y) * (t - y)));
        }
        return 1e9 * sum;
      };
      for (const double elastic : {0.0, 0.01, 0.02, 0.03}) {
        curves += fmt::format("{},{},{}\n", plastic, elastic, pressure(elastic) - pressure(0));
      }
    }
    folder.write("tables/unloading.csv", curves);

    CHECK(warned_of(measure, "", {}).empty());
    CHECK_THAT(warned_of(measure, "y_conversion_factor", 1), Contains("likely pressures in MPa that are read as Pa"));
    CHECK_THAT(
        warned_of(measure, "X_conversion_factor", {1, 1}),
        Contains("\"svr\" has 0.0") && Contains("or a scale or conversion factor that is inverted or left at 1"));
    CHECK_THAT(warned_of(measure, "y_scale", 1e3), Contains("likely pressures in MPa that are read as Pa"));
  }
}

}  // namespace test_compare_modulus
