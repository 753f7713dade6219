#include "components/moduli/engineering_strain.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/components/materials/concrete_sand.hpp"

namespace test_engineering_strain
{

using tamp::components::ElasticPoint;
using tamp::components::EngineeringStrain;
using tamp::components::StrainRange;
using tamp::components::UnloadingTable;

namespace
{

const EngineeringStrain<UnloadingTable>& converted()
{
  static const EngineeringStrain<UnloadingTable> model(concrete_sand::unloading());
  return model;
}

}  // namespace

TEST_CASE("an engineering strain of 45 % is a logarithmic one of 0.598")
{
  CHECK(tamp::components::logarithmic_strain(0.45) == Approx(0.5978370007556204));
  CHECK(tamp::components::engineering_strain(0.5978370007556204) == Approx(0.45));
}

TEST_CASE("a model in engineering strain has the pressure of the measured strains")
{
  const double plastic = 0.2, elastic = 0.03;  // engineering
  const double log_plastic = -std::log(1 - plastic), log_elastic = -std::log(1 - plastic - elastic) - log_plastic;

  const ElasticPoint point = converted().at(log_elastic, log_plastic);

  CHECK(point.pressure == Approx(concrete_sand::unloading().at(elastic, plastic).pressure).epsilon(1e-12));
}

TEST_CASE("modulus and coupling of a converted model are the derivatives of its pressure")
{
  const double h = 1e-7;
  for (double plastic : {0.05, 0.2, 0.37}) {
    for (double elastic : {0.001, 0.01, 0.05}) {
      const auto pressure = [](double e, double ep) { return converted().at(e, ep).pressure; };
      const ElasticPoint point = converted().at(elastic, plastic);
      const double by_elastic = (pressure(elastic + h, plastic) - pressure(elastic - h, plastic)) / (2 * h);
      const double by_plastic = (pressure(elastic, plastic + h) - pressure(elastic, plastic - h)) / (2 * h);

      CHECK(point.bulk_modulus == Approx(by_elastic).epsilon(1e-5));
      CHECK(point.coupling == Approx(by_plastic).epsilon(1e-3).margin(1e-4 * point.bulk_modulus));
    }
  }
}

TEST_CASE("the range of a converted model lies within the model's own")
{
  const StrainRange range = converted().range(), own = concrete_sand::unloading().range();

  for (double elastic : {range.least_elastic, range.most_elastic}) {
    for (double plastic : {range.least_plastic, range.most_plastic}) {
      const double measured_plastic = 1 - std::exp(-plastic);
      const double measured_elastic = 1 - std::exp(-plastic - elastic) - measured_plastic;
      CHECK(measured_plastic <= own.most_plastic * (1 + 1e-12));
      CHECK(measured_elastic <= own.most_elastic * (1 + 1e-12));
      CHECK(measured_elastic >= own.least_elastic * (1 + 1e-12));
    }
  }
}

}  // namespace test_engineering_strain
