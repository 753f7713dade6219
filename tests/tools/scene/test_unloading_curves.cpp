#include <catch2/catch.hpp>

#include <cmath>
#include <nlohmann/json.hpp>

#include "components/moduli/unloading_table.hpp"
#include "tests/tools/problems.hpp"
#include "tools/scene/materials/unloading_curves.hpp"

namespace test_unloading_curves
{

using namespace tamp;
using namespace tamp::test;
using nlohmann::json;
using tools::read_unloading_curves;
using tools::StrainMeasure;
using tools::Table;

namespace
{

json published(const std::vector<double>& plastic, const json& curves)
{
  return {{"Vaango_tabular_data", {{"Data", {{"PlasticStrainVol", plastic}, {"Data", curves}}}}}};
}

/// Two curves of pressure against total strain, with what the published tables have besides: a negative plastic strain,
/// a part in tension, and a curve that starts a little above zero pressure.
json pressure_of_total()
{
  return published({-0.05, 0.05, 0.1},
                   {{{"TotalStrainVol", {-0.05, 0.01}}, {"Pressure", {0, 1e6}}},
                    {{"TotalStrainVol", {0.04, 0.05, 0.055, 0.06}}, {"Pressure", {-2e6, 0, 5e6, 1e7}}},
                    {{"TotalStrainVol", {0.105, 0.11}}, {"Pressure", {1e7, 2e7}}}});
}

/// The bulk modulus against `abscissa`, one curve for plastic strain 0 and one with the same numbers for 0.1.
json bulk_modulus(const char* abscissa, const std::vector<double>& x, const std::vector<double>& modulus)
{
  const json curve = {{abscissa, x}, {"BulkModulus", modulus}};
  return published({0, 0.1}, {curve, curve});
}

Table read(const json& content, StrainMeasure measure = StrainMeasure::logarithmic)
{
  const TemporaryFolder folder;
  return read_unloading_curves(folder.write("t.json", content.dump()), measure);
}

std::string problems_of_table(const json& content)
{
  const TemporaryFolder folder;
  const auto file = folder.write("t.json", content.dump());
  return problems_of_reading(folder, [&] { read_unloading_curves(file, StrainMeasure::logarithmic); });
}

/// The table of pressures after one change below its "Data".
std::string problems_with(const std::string& pointer, const json& value)
{
  json content = pressure_of_total();
  content[json::json_pointer("/Vaango_tabular_data/Data" + pointer)] = value;
  return problems_of_table(content);
}

const std::string data = "t.json#/Vaango_tabular_data/Data";

}  // namespace

TEST_CASE("a published table of pressures gives the same curves as the text file")
{
  const TemporaryFolder folder;
  const auto text = folder.write("t.csv",
                                 "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
                                 "0.05,0,0\n0.05,0.005,5e6\n0.05,0.01,1e7\n0.1,0,0\n0.1,0.005,1e7\n0.1,0.01,2e7\n");

  const Table expected = read_unloading_curves(text, StrainMeasure::logarithmic), found = read(pressure_of_total());

  CHECK(found.columns[0] == expected.columns[0]);
  CHECK(found.columns[2] == expected.columns[2]);
  REQUIRE(found.n_rows() == 6);
  for (std::size_t i = 0; i < 6; ++i) CHECK(found.columns[1][i] == Approx(expected.columns[1][i]).margin(1e-15));
  CHECK(found.columns[1][3] == 0);
}

TEST_CASE("a bulk modulus against pressure is integrated to the curve that has it")
{
  const double least = 1e9, slope = 20;

  const Table table = read(bulk_modulus("Pressure", {-1e7, 0, 1e8}, {1e9, 1e9, 3e9}));

  const std::vector<double>&elastic = table.columns[1], &pressure = table.columns[2];
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    CHECK(elastic[i] == Approx(std::log1p(slope * pressure[i] / least) / slope).epsilon(1e-13));
  }
  CHECK(pressure.back() == 1e8);
  const components::UnloadingTable model(table.columns[0], elastic, pressure);
  const components::ElasticPoint middle = model.at(std::log(2) / slope, 0.05);
  CHECK(middle.pressure == Approx(5e7).epsilon(1e-3));
  CHECK(middle.bulk_modulus == Approx(2e9).epsilon(5e-3));
}

TEST_CASE("a bulk modulus against elastic strain is integrated to the curve that has it")
{
  const Table table = read(bulk_modulus("ElasticStrainVol", {0.01, 0.05}, {1e9, 3e9}));

  // Constant up to the first point, then rising by 5e10 per unit of strain.
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const double e = table.columns[1][i], beyond = std::max(e - 0.01, 0.0);
    CHECK(table.columns[2][i] == Approx(1e9 * e + 2.5e10 * beyond * beyond).epsilon(1e-13));
  }
  CHECK(table.columns[1].back() == 0.05);
}

TEST_CASE("a curve of two points makes a table, and so do two curves that are alike")
{
  const Table table = read(bulk_modulus("Pressure", {0, 1e8}, {1e9, 1e9}));

  const components::UnloadingTable model(table.columns[0], table.columns[1], table.columns[2]);

  CHECK(model.at(0.05, 0.07).pressure == Approx(5e7));
  CHECK(model.at(0.05, 0.07).bulk_modulus == Approx(1e9));
}

TEST_CASE("a curve for plastic strain zero that is the path of loading ends half way to the next one")
{
  const json loading = {{"TotalStrainVol", {0, 0.02, 0.04, 0.06, 0.08, 0.1}},
                        {"Pressure", {0, 1e6, 2e6, 3e6, 4e6, 5e6}}};
  const json unloading = {{"TotalStrainVol", {0.1, 0.11, 0.12}}, {"Pressure", {0, 1e8, 2e8}}};

  const Table table = read(published({0, 0.1}, {loading, unloading}));

  CHECK(table.columns[1][2] == 0.04);
  CHECK(table.columns[0] == std::vector<double>{0, 0, 0, 0.1, 0.1, 0.1});
}

TEST_CASE("engineering strains are converted, the elastic ones as the difference of total and plastic")
{
  const Table table = read(pressure_of_total(), StrainMeasure::engineering);

  CHECK(table.columns[0][0] == Approx(-std::log(0.95)));
  CHECK(table.columns[1][0] == 0);
  CHECK(table.columns[1][2] == Approx(std::log(0.95 / 0.94)));
  CHECK(table.columns[1][5] == Approx(std::log(0.9 / 0.89)));
  CHECK_THROWS_WITH(
      read(published({1.1}, {{{"TotalStrainVol", {1.2, 1.3}}, {"Pressure", {1, 2}}}}), StrainMeasure::engineering),
      Catch::Contains("strain 1.1; expected engineering strains below 1"));
}

TEST_CASE("a variable of one entry is left out of account, one of more is reported with the others")
{
  const json inner = pressure_of_total()["Vaango_tabular_data"]["Data"];
  json content;
  content["Vaango_tabular_data"]["Data"] = {{"Temperature", {293}}, {"Data", {inner}}};
  CHECK(read(content).columns == read(pressure_of_total()).columns);

  content["Vaango_tabular_data"]["Data"] = {{"Temperature", {293, 350}}, {"Data", {inner, inner}}};
  CHECK(problems_of_table(content) ==
        data +
            ": a table of Temperature (2 entries), PlasticStrainVol (3 entries), Pressure, TotalStrainVol; expected "
            "a level PlasticStrainVol, and one entry of every other");
}

TEST_CASE("a table of other variables is reported with those it has")
{
  CHECK(problems_with("/Data/0", {{"Strain", {0, 1}}, {"Pressure", {0, 1}}}) ==
        data +
            ": a table of PlasticStrainVol (3 entries), Pressure, Strain; expected, for each PlasticStrainVol, "
            "Pressure against TotalStrainVol or ElasticStrainVol, or BulkModulus against Pressure or "
            "ElasticStrainVol");
  CHECK(problems_of_table({{"Vaango_tabular_data", {{"Data", {{"TotalStrainVol", {0, 1}}, {"Pressure", {0, 1}}}}}}}) ==
        data +
            ": a table of Pressure, TotalStrainVol; expected a level PlasticStrainVol, and one entry of every other");
  CHECK(problems_of_table({{"Vaango_tabular_data", 1}}) == data +
                                                               ": missing; expected an object with the lists of a "
                                                               "table");
}

TEST_CASE("lists of a table that are none, or whose lengths differ, are reported with their place")
{
  CHECK(problems_with("/Data/1/Pressure/2", nullptr) == data + "/Data/1/Pressure/2: null; expected a number");
  CHECK(problems_with("/Data/1/TotalStrainVol/0", "0.04") ==
        data + "/Data/1/TotalStrainVol/0: \"0.04\"; expected a number");
  CHECK(problems_with("/Data/1/Pressure", 5) == data + "/Data/1/Pressure: number; expected a list of numbers");
  CHECK(problems_with("/Data/2/TotalStrainVol", {0.105, 0.11, 0.12}) ==
        data + "/Data/2/TotalStrainVol: 3 numbers; expected 2, as of Pressure");
  CHECK(problems_with("/PlasticStrainVol", {0, 0.1}) ==
        data + "/Data: 3 entries; expected 2, one for each number of PlasticStrainVol");
  CHECK(problems_with("/Data/2", {{"TotalStrainVol", {0.11}}, {"Pressure", {1}}}) ==
        data + "/Data/2: a curve of 1 points; expected at least two");
  CHECK(problems_with("/Data/2", 7) == data + "/Data/2: number; expected an object");
}

TEST_CASE("abscissae that do not ascend are reported with their place")
{
  CHECK(problems_with("/Data/1/TotalStrainVol/2", 0.05) ==
        data +
            "/Data/1/TotalStrainVol/2: TotalStrainVol 0.050000 after 0.050000; expected values that strictly "
            "increase");
  CHECK(problems_with("/PlasticStrainVol/2", 0.05) ==
        data + "/Data/2: PlasticStrainVol 0.05 after 0.05; expected plastic strains that strictly increase");
}

TEST_CASE("pressure before the plastic strain, and a curve without pressure, are reported")
{
  CHECK(problems_with("/Data/1/Pressure", {-1, 1, 2, 3}) ==
        data + "/Data/1/Pressure/1: 1 at TotalStrainVol 0.05; expected no pressure up to the plastic strain, 0.05");
  CHECK(problems_with("/Data/1/Pressure", {-4, -3, -2, -1}) ==
        data + "/Data/1: no point in compression; expected pressures above 0");
}

TEST_CASE("a bulk modulus that is not above zero is reported with its place")
{
  for (const double bad : {0.0, -1e9}) {
    CHECK_THAT(
        problems_of_table(bulk_modulus("Pressure", {0, 1e8}, {1e9, bad})),
        Catch::StartsWith(data + "/Data/0/BulkModulus/1: ") && Catch::EndsWith("; expected a bulk modulus above 0"));
  }
}

}  // namespace test_unloading_curves
