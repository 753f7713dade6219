#include <catch2/catch.hpp>

#include <cmath>
#include <nlohmann/json.hpp>

#include "tests/tools/problems.hpp"
#include "tests/tools/scene/small_models.hpp"
#include "tests/tools/scene/small_scene.hpp"
#include "tools/scene/materials/read_material.hpp"
#include "tools/scene/materials/read_modulus.hpp"

namespace test_read_modulus
{

using namespace tamp;
using namespace tamp::test;
using components::ElasticPoint;
using nlohmann::json;

namespace
{

/// The small sand with a model of each type.
void write_sand_of_three_models(const TemporaryFolder& folder)
{
  write_sand(folder);
  folder.write("models/svr.json", small_regression);
  write_keras(folder.path() / "models/network.h5", small_network);
  json sand = json::parse(read_text(folder.path() / "sand.json"));
  sand["modulus"]["svr"] = "models/svr.json";
  sand["modulus"]["mlp"] = "models/network.h5";
  folder.write("sand.json", sand.dump());
}

const components::Modulus& modulus_of(const tasks::SceneMaterial& material)
{
  return std::get<components::TabularCap>(material.model).parameters().modulus;
}

ElasticPoint at(const components::Modulus& modulus, double elastic, double plastic)
{
  return std::visit([&](const auto& model) { return model.at(elastic, plastic); }, modulus);
}

components::Modulus modulus_of_sand(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  write_sand_of_three_models(folder);
  return modulus_of(tools::read_checked_material(folder.path() / "sand.json", assignments).material);
}

std::string problems_of_sand(const std::vector<std::string>& assignments)
{
  const TemporaryFolder folder;
  write_sand_of_three_models(folder);
  write_keras(folder.path() / "models/plain.h5", {.layers = small_network.layers});
  return problems_of_reading(folder, [&] { tools::read_checked_material(folder.path() / "sand.json", assignments); });
}

/// The small regression, written out: pressure and K of total and plastic strain.
ElasticPoint plain_regression(double total, double plastic)
{
  const double x = (100 * total + 10) * 0.02, y = 100 * plastic * 0.04;
  double sum = 0.4, by_x = 0;
  for (const auto& [a, s, t] : {std::array{1.0, 1.2, 0.0}, {0.5, 1.1, 1.0}, {-0.25, -0.1, 0.5}}) {
    const double kernel = std::exp(-0.5 * ((s - x) * (s - x) + (t - y) * (t - y)));
    sum += a * kernel;
    by_x += a * (s - x) * kernel;
  }
  return {1e6 * (sum * 1000 - 200), 1e9 * 2 * by_x, 0};
}

/// The small network, written out.
double plain_network(double elastic, double plastic)
{
  const double x = (elastic - 0.03) / 0.05, y = (plastic - 0.2) / 0.15;
  const double a = std::max(0.7 * x + 0.2 * y + 0.3, 0.0), b = std::max(0.1 * x + 0.9 * y - 0.1, 0.0);
  const double c = 1 / (1 + std::exp(-(1.1 * a + 0.5 * b + 0.1))), d = 1 / (1 + std::exp(-(0.4 * a + 0.8 * b + 0.2)));
  const double e = std::tanh(0.6 * c + 0.3 * d - 0.2), f = std::tanh(0.2 * c + 0.7 * d + 0.1);
  return 2e10 + 1e10 * (1.5 * e + 0.5 * f - 0.3);
}

}  // namespace

TEST_CASE("one assignment changes the type of a modulus")
{
  CHECK(std::holds_alternative<components::UnloadingTable>(modulus_of_sand({})));
  CHECK(std::holds_alternative<components::SupportVectorModulus>(modulus_of_sand({"/modulus/type=svr"})));
  CHECK(std::holds_alternative<components::NetworkModulus>(modulus_of_sand({"/modulus/type=mlp"})));
}

TEST_CASE("a material's regression is the published formula, with no pressure at elastic strain zero")
{
  const components::Modulus modulus = modulus_of_sand({"/modulus/type=svr"});

  for (const double plastic : {0.0, 0.07, 0.2}) {
    for (const double elastic : {0.0, 0.01, 0.05, 0.1}) {
      const ElasticPoint found = at(modulus, elastic, plastic), expected = plain_regression(elastic + plastic, plastic);
      const double at_zero = plain_regression(plastic, plastic).pressure;
      CHECK(found.pressure == Approx(expected.pressure - at_zero).epsilon(1e-10).margin(1e-4));
      CHECK(found.bulk_modulus == Approx(expected.bulk_modulus).epsilon(1e-10));
    }
  }
}

TEST_CASE("a material's network has the K of its layers")
{
  const components::Modulus modulus = modulus_of_sand({"/modulus/type=mlp"});

  for (const double plastic : {0.0, 0.07, 0.2}) {
    for (const double elastic : {0.0, 0.01, 0.05, 0.1}) {
      CHECK(at(modulus, elastic, plastic).bulk_modulus == Approx(plain_network(elastic, plastic)).epsilon(1e-10));
    }
  }
}

TEST_CASE("a model's file by itself has the pressure of its own fit")
{
  const TemporaryFolder folder;

  const components::Modulus modulus = tools::read_model_file(folder.write("svr.json", small_regression), std::nullopt);

  CHECK(at(modulus, 0.02, 0.1).pressure == Approx(plain_regression(0.12, 0.1).pressure).epsilon(1e-10));
}

TEST_CASE("a network's scaling and range may stand in the material")
{
  const std::vector<std::string> plain{"/modulus/type=mlp", "/modulus/mlp=models/plain.h5"};
  const TemporaryFolder folder;
  write_sand_of_three_models(folder);
  write_keras(folder.path() / "models/plain.h5", {.layers = small_network.layers});
  json sand = json::parse(read_text(folder.path() / "sand.json"));
  sand["modulus"] = {
      {"type", "mlp"}, {"mlp", "models/plain.h5"}, {"scaling", small_network.scaling}, {"range", small_network.range}};
  const auto file = folder.write("sand.json", sand.dump());

  const components::Modulus modulus = modulus_of(tools::read_checked_material(file).material);

  CHECK(at(modulus, 0.02, 0.1).bulk_modulus == Approx(plain_network(0.02, 0.1)).epsilon(1e-10));
  const std::string problems =
      problems_of_reading(folder, [&] { tools::read_checked_material(file, {"/modulus/scaling=null"}); });
  CHECK(problems == "--set#/modulus/scaling: missing, and not in models/plain.h5 either; expected 6 numbers");
}

TEST_CASE("a network of published layout and no range is asked over two deviations")
{
  const TemporaryFolder folder;
  const auto file = folder.path() / "plain.h5";
  write_keras(file, {.layers = small_network.layers});

  const components::Modulus modulus = tools::read_model_file(file, small_network.scaling);

  CHECK(at(modulus, 0.02, 0.1).bulk_modulus == Approx(plain_network(0.02, 0.1)).epsilon(1e-10));
  CHECK(std::get<components::NetworkModulus>(modulus).range().most_plastic == Approx(0.5));
  CHECK_THROWS_WITH(tools::read_model_file(file, std::nullopt), Catch::Contains("expected --scaling mean_e,sd_e,"));
}

TEST_CASE("the files of the types that are not chosen need not be there")
{
  CHECK(problems_of_sand({"/modulus/svr=no.json", "/modulus/mlp=no.h5"}).empty());
  CHECK(problems_of_sand({"/modulus/type=svr", "/modulus/svr=no.json"}) ==
        "--set#/modulus/svr: there is no file no.json; expected the path of a file");
}

TEST_CASE("the keys of a modulus that are wrong are reported")
{
  CHECK(problems_of_sand({"/modulus/type=tabl"}) ==
        "--set#/modulus/type: \"tabl\"; expected one of table, svr, mlp, did you mean \"table\"?");
  CHECK(problems_of_sand({"/modulus/compile=1"}) == "--set#/modulus/compile: 1; expected a number above 0 and below 1");
  CHECK(problems_of_sand({"/modulus/scaling=[1,2]"}) == "--set#/modulus/scaling: [1,2]; expected 6 numbers");
  CHECK(problems_of_sand({"/modulus/file=\"x\""}) ==
        "--set#/modulus/file: unknown key; expected one of compile, mlp, range, scaling, svr, table, type");
  CHECK(problems_of_sand({"/strain_measure=green"}) ==
        "--set#/strain_measure: \"green\"; expected one of logarithmic, engineering");
}

TEST_CASE("a compiled modulus answers as its model does, within its tolerance")
{
  const components::Modulus model = modulus_of_sand({"/modulus/type=svr"});

  const components::Modulus surface = modulus_of_sand({"/modulus/type=svr", "/modulus/compile=1e-3"});

  REQUIRE(std::holds_alternative<components::ModulusSurface>(surface));
  const ElasticPoint expected = at(model, 0.02, 0.1), found = at(surface, 0.02, 0.1);
  CHECK(found.bulk_modulus == Approx(expected.bulk_modulus).epsilon(1e-3));
  CHECK(found.pressure == Approx(expected.pressure).epsilon(1e-3).margin(1e-6 * expected.bulk_modulus));
}

TEST_CASE("numbers in engineering strain are converted, and a fit to such strains is asked in them")
{
  const double elastic = 0.01, plastic = 0.1;
  const double total_then = 1 - std::exp(-(elastic + plastic)), plastic_then = 1 - std::exp(-plastic);

  const components::Modulus regression = modulus_of_sand({"/modulus/type=svr", "/strain_measure=engineering"});

  const double expected = plain_regression(total_then, plastic_then).pressure;
  const double at_zero = plain_regression(plastic_then, plastic_then).pressure;
  CHECK(at(regression, elastic, plastic).pressure == Approx(expected - at_zero).epsilon(1e-10));
  const TemporaryFolder folder;
  write_sand_of_three_models(folder);
  const auto sand = std::get<components::TabularCap>(
      tools::read_checked_material(folder.path() / "sand.json", {"/strain_measure=engineering"}).material.model);
  CHECK(sand.crush_pressure(-std::log(0.9)) == Approx(2e7));
  // The first unloading curve ends at total strain 0.06, pressure 1e7.
  CHECK(at(sand.parameters().modulus, std::log(0.95 / 0.94), -std::log(0.95)).pressure == Approx(1e7).epsilon(2e-3));
}

TEST_CASE("published tables stand in for every table of a material")
{
  const TemporaryFolder folder;
  write_sand_of_three_models(folder);
  const auto write = [&](const std::string& name, const json& lists) {
    folder.write(name, json{{"Vaango_tabular_data", {{"Data", lists}}}}.dump());
  };
  write("tables/crush.json", {{"PlasticStrainVol", {0, 0.1, 0.2}}, {"Pressure", {1e6, 2e7, 1e8}}});
  write("tables/yield.json", {{"Pressure", {-1e4, 1e6, 1e8}}, {"SqrtJ2", {0, 6e5, 5e7}}});
  write("tables/hydrostat.json", {{"TotalStrainVol", {0, 0.1, 0.2}}, {"Pressure", {0, 1e7, 1e8}}});
  json sand = json::parse(read_text(folder.path() / "sand.json"));
  sand["crush_curve"] = "tables/crush.json";
  sand["hydrostat"] = "tables/hydrostat.json";
  sand["yield"]["file"] = "tables/yield.json";
  sand["yield"]["measure"] = "sqrt_J2";
  const auto file = folder.write("sand.json", sand.dump());

  const tasks::SceneMaterial material = tools::read_checked_material(file).material;

  CHECK(std::get<components::TabularCap>(material.model).crush_pressure(0.1) == 2e7);
  write("tables/yield.json", {{"Pressure", {-1e4, 1e6}}, {"SqrtJ", {0, 6e5}}});
  write("tables/crush.json", {{"PlasticStrainVol", {0, 0.1, 0.1}}, {"Pressure", {1e6, 2e7, 1e8}}});
  const std::string problems = problems_of_reading(folder, [&] { tools::read_checked_material(file); });
  CHECK_THAT(problems, Catch::Contains("tables/yield.json#/Vaango_tabular_data/Data: a table of Pressure, SqrtJ; "
                                       "expected Pressure, SqrtJ2"));
  CHECK_THAT(problems, Catch::Contains("tables/crush.json#/Vaango_tabular_data/Data/PlasticStrainVol/2: abscissa "));
}

TEST_CASE("a material's file may name another, over which its own keys are merged")
{
  const TemporaryFolder folder;
  write_sand_of_three_models(folder);
  folder.write("more/svr.json", R"({"file": "../sand.json", "modulus": {"type": "svr"}, "density": 1700})");
  const auto file = folder.write("last.json", R"({"file": "more/svr.json", "density": 1800})");

  const tasks::SceneMaterial material = tools::read_checked_material(file).material;

  CHECK(material.name == "last");
  CHECK(material.density == 1800);
  CHECK(std::holds_alternative<components::SupportVectorModulus>(modulus_of(material)));
  CHECK(problems_of_reading(folder,
                            [&] {
                              tools::read_checked_material(file, {"/poisson_ratio=1", "/density=null"});
                            }) ==
        "--set#/density: missing; expected a number above 0 [kg/m^3]\n"
        "--set#/poisson_ratio: 1; expected a number above -1 and below 0.5");
  folder.write("more/svr.json", R"({"file": "../sand.json", "density": -1, "poisson_ratio": 2})");
  CHECK(problems_of_reading(folder, [&] { tools::read_checked_material(folder.path() / "more/svr.json"); }) ==
        "more/svr.json#/density: -1; expected a number above 0 [kg/m^3]\n"
        "more/svr.json#/poisson_ratio: 2; expected a number above -1 and below 0.5");
}

TEST_CASE("files of materials that name each other in a ring are reported")
{
  const TemporaryFolder folder;
  folder.write("a.json", R"({"file": "b.json"})");
  folder.write("b.json", R"({"file": "a.json"})");

  const std::string problems =
      problems_of_reading(folder, [&] { tools::read_checked_material(folder.path() / "a.json"); });

  CHECK_THAT(problems, Catch::Contains("b.json#/file: ") && Catch::Contains("names itself"));
}

}  // namespace test_read_modulus
