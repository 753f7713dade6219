#include "components/moduli/unloading_table.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"
#include "tests/components/materials/concrete_sand.hpp"

namespace test_unloading_table
{

using tamp::components::BadValue;
using tamp::components::ElasticPoint;
using tamp::components::UnloadingTable;

namespace
{

BadValue refusal(std::vector<double> plastic, std::vector<double> elastic, std::vector<double> pressure)
{
  try {
    UnloadingTable(plastic, elastic, pressure);
  } catch (const BadValue& bad) {
    return bad;
  }
  return {"nothing", "a refusal", -2};
}

}  // namespace

TEST_CASE("the pressure surface passes within 0.1 % of every measured unloading point")
{
  const auto rows = concrete_sand::columns("unloading.csv");
  const UnloadingTable& table = concrete_sand::unloading();

  double worst = 0;
  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    if (rows[2][i] == 0) continue;
    worst = std::max(worst, std::abs(table.at(rows[1][i], rows[0][i]).pressure / rows[2][i] - 1));
  }
  CHECK(worst < 1e-3);
}

TEST_CASE("the resampled surface is within 0.2 % of its definition, and its modulus within 1 %")
{
  const UnloadingTable& table = concrete_sand::unloading();

  double worst_pressure = 0, worst_modulus = 0;
  for (int i = 1; i < 40; ++i) {
    for (int j = 0; j < 40; ++j) {
      const double elastic = 0.14 * i * i / 1600.0, plastic = 0.32 * (j + 0.37) / 40;
      const ElasticPoint fast = table.at(elastic, plastic), plain = table.defined_at(elastic, plastic);
      worst_pressure = std::max(worst_pressure, std::abs(fast.pressure / plain.pressure - 1));
      worst_modulus = std::max(worst_modulus, std::abs(fast.bulk_modulus / plain.bulk_modulus - 1));
    }
  }
  CHECK(worst_pressure < 2e-3);
  CHECK(worst_modulus < 1e-2);
}

TEST_CASE("bulk modulus and coupling are the derivatives of the pressure")
{
  const UnloadingTable& table = concrete_sand::unloading();

  for (double elastic : {-0.01, 0.003, 0.02, 0.05, 0.1, 0.25}) {
    for (double plastic : {0.01, 0.1, 0.2, 0.29, 0.31}) {
      const double h = 1e-7;
      const ElasticPoint point = table.at(elastic, plastic);
      const double by_elastic =
          (table.at(elastic + h, plastic).pressure - table.at(elastic - h, plastic).pressure) / (2 * h);
      const double by_plastic =
          (table.at(elastic, plastic + h).pressure - table.at(elastic, plastic - h).pressure) / (2 * h);
      CHECK(point.bulk_modulus == Approx(by_elastic).epsilon(1e-5));
      CHECK(point.coupling == Approx(by_plastic).epsilon(1e-4).margin(1e-5 * point.bulk_modulus));
    }
  }
}

TEST_CASE("the modulus is positive and greater than the coupling all over the range of the tests")
{
  const UnloadingTable& table = concrete_sand::unloading();

  double least = 1e300, least_margin = 1e300;
  for (int i = 0; i <= 300; ++i) {
    for (int j = 0; j <= 300; ++j) {
      const ElasticPoint point = table.at(-0.02 + 0.16 * i / 300, 0.3199 * j / 300);
      least = std::min(least, point.bulk_modulus);
      least_margin = std::min(least_margin, 1 - point.coupling / point.bulk_modulus);
    }
  }
  CHECK(least >= 0.999 * table.least_bulk_modulus());
  CHECK(table.least_bulk_modulus() > 0.9 * 424.5e6);  // the softest measured modulus
  CHECK(least_margin > 0);
}

TEST_CASE("in tension the pressure goes on straight, and dilated sand counts as unstrained")
{
  const UnloadingTable& table = concrete_sand::unloading();

  const double modulus = table.at(0, 0.1).bulk_modulus;

  CHECK(table.at(-0.01, 0.1).pressure == Approx(-0.01 * modulus));
  CHECK(table.at(-0.01, 0.1).bulk_modulus == Approx(modulus));
  CHECK(table.at(0.01, -0.2).pressure == table.at(0.01, 0).pressure);
  CHECK(table.at(0.01, -0.2).coupling == 0);
}

TEST_CASE("the elastic strain at a pressure gives that pressure back")
{
  const UnloadingTable& table = concrete_sand::unloading();

  for (double pressure : {-2e4, 0.0, 3e3, 1e5, 2e7, 6e8, 9e9}) {
    for (double plastic : {0.0, 0.15, 0.31}) {
      const double elastic = elastic_volumetric_at(table, pressure, plastic);
      CHECK(table.at(elastic, plastic).pressure == Approx(pressure).epsilon(1e-12).margin(1e-6));
    }
  }
}

TEST_CASE("the modulus by pressure is the slope of the measured curve, and constant beyond it")
{
  const auto rows = concrete_sand::columns("unloading.csv");
  const UnloadingTable& table = concrete_sand::unloading();

  for (std::size_t i = 1; i + 1 < rows[0].size(); ++i) {
    if (rows[0][i - 1] != rows[0][i + 1]) continue;
    const double below = (rows[2][i] - rows[2][i - 1]) / (rows[1][i] - rows[1][i - 1]);
    const double above = (rows[2][i + 1] - rows[2][i]) / (rows[1][i + 1] - rows[1][i]);
    const double modulus = table.rate_modulus(rows[2][i], 0, rows[0][i]);
    REQUIRE(modulus > 0.995 * std::min(below, above));
    REQUIRE(modulus < 1.005 * std::max(below, above));
  }
  CHECK(table.rate_modulus(1e9, 0, 0.05) == Approx(table.rate_modulus(1.7e7, 0, 0.05)).epsilon(1e-3));
  CHECK(table.rate_modulus(-1e6, 0, 0.2) == table.rate_modulus(0, 0, 0.2));
}

TEST_CASE("a batch of states gives bitwise what each state gives alone")
{
  const UnloadingTable& table = concrete_sand::unloading();
  const std::vector<double> elastic{-0.01, 0, 0.02, 0.3}, plastic{0.1, -0.1, 0.25, 0.31}, pressure{-1, 0, 1e7, 1e9};
  std::vector<ElasticPoint> points(4);
  std::vector<double> moduli(4);

  evaluate<UnloadingTable>(table, elastic, plastic, points);
  evaluate_rate<UnloadingTable>(table, pressure, elastic, plastic, moduli);

  for (std::size_t i = 0; i < 4; ++i) {
    CHECK(points[i].pressure == table.at(elastic[i], plastic[i]).pressure);
    CHECK(points[i].coupling == table.at(elastic[i], plastic[i]).coupling);
    CHECK(moduli[i] == table.rate_modulus(pressure[i], 0, plastic[i]));
  }
}

TEST_CASE("unloading curves that are out of order, do not start at zero, or cross are refused with their row")
{
  CHECK(refusal({0, 0, 0, 0}, {0, 1, 2, 1.5}, {0, 1, 2, 3}).row == 3);
  CHECK(refusal({0, 0, 0, 0}, {0, 1, 2, 3}, {0, 1, 1, 3}).row == 2);
  CHECK(refusal({0, 0, 0, .1, .1, .1}, {0, 1, 2, .1, 1, 2}, {0, 1, 2, 0, 1, 2}).row == 3);
  CHECK(refusal({.1, .1, .1, 0, 0, 0}, {0, 1, 2, 0, 1, 2}, {0, 1, 2, 0, 1, 2}).row == 3);
  // At pressure 2 the second curve has 0.1 + 0.01 of total strain, the first 0 + 0.2.
  const BadValue crossing = refusal({0, 0, 0, .1, .1, .1}, {0, .1, .2, 0, .005, .01}, {0, 1, 2, 0, 1, 2});
  CHECK(crossing.row == 3);
  CHECK(crossing.expected == "more total strain on the curve of more plastic strain");
}

TEST_CASE("unloading curves that run towards each other too fast are refused with their strains and the pressure")
{
  const BadValue near =
      refusal({.1, .1, .1, .2, .2, .2, .2}, {0, .01, .02, 0, .0049, .005, .02}, {0, 1e7, 4e7, 0, 1e5, 2e7, 3e7});

  CHECK_THAT(near.found, Catch::StartsWith("near the curves of plastic strain 0.100000 and 0.200000 ") &&
                             Catch::Contains(" at pressure "));
  CHECK(near.row == 3);
}

TEST_CASE("the modulus' derivative by plastic strain is that of the surface")
{
  const UnloadingTable& table = concrete_sand::unloading();
  const double h = 1e-7;

  for (double plastic : {0.02, 0.1, 0.2, 0.31}) {
    for (double elastic : {0.002, 0.02, 0.05}) {
      const double change = table.at(elastic, plastic + h).bulk_modulus - table.at(elastic, plastic - h).bulk_modulus;
      CHECK(table.modulus_by_plastic(elastic, plastic) == Approx(change / (2 * h)).epsilon(0.05).margin(1e9));
    }
  }
}

TEST_CASE("states beyond the measured curves are out of range")
{
  const UnloadingTable& table = concrete_sand::unloading();

  CHECK(table.in_range(0.02, 0.05));
  CHECK(table.in_range(0.13, 0.32));
  CHECK_FALSE(table.in_range(0.13, 0.05));
  CHECK_FALSE(table.in_range(0.01, 0.33));
  CHECK_FALSE(table.in_range(-0.01, 0.1));
}

}  // namespace test_unloading_table
