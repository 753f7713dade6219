#include "components/problems/compacted_column.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/components/problems/force_needed.hpp"

namespace test_compacted_column
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double column_density = 1624;
const CompactedColumn short_column{.length = 0.4, .compaction = 0.2, .duration = 4e-3};

/// sigma_xx after a straight path of uniaxial strain [Pa].
template <class Model>
double stress_at(const Model& model, double stretch)
{
  constexpr int n_steps = 2000;
  test::OneParticle<2, Model> particle;
  for (int i = 1; i <= n_steps; ++i) {
    particle.deformation_gradient(0, 0) = std::pow(stretch, static_cast<double>(i) / n_steps);
    particle.strain(model, SymmetricTensor<2>(std::log(stretch) / n_steps, 0, 0, 0));
  }
  return particle.stress[0];
}

/// The force per mass that the column's motion along x needs, its stress being a function of the stretch [m/s^2].
template <class Stress>
double force_along(const BodyFunctions& column, const Stress& stress, double x, double t, double step)
{
  const auto place = [&](double at, double time) { return column.exact_displacement({at, 0, 0}, time)[0]; };
  const auto stress_there = [&](double at) {
    return stress(1 + test::slope([&](double s) { return place(s, t); }, at, 1e-3));
  };
  const auto velocity = [&](double time) { return test::slope([&](double s) { return place(x, s); }, time, 1e-5); };
  return test::slope(velocity, t, 1e-5) - test::slope(stress_there, x, step) / column_density;
}

}  // namespace

TEST_CASE("the body force of a compacted column is what its stress needs, in closed form")
{
  const double K = 4e8, G = 3e8, x = GENERATE(0.05, 0.2, 0.26), t = GENERATE(2.2e-3, 3e-3);
  const Hypoelastic elastic{K, G};
  // Cohesion and friction as parts of the mean stress that sqrt(J2) may reach; without dilation.
  const DruckerPrager soil{.bulk_modulus = K, .shear_modulus = G, .friction_angle = 30, .cohesion = 1e6};
  const double alpha = 2 * std::numbers::sqrt3 * 0.5 / 2.5,
               strength = 2 * std::numbers::sqrt3 * 1e6 * std::sqrt(0.75) / 2.5;

  const double of_elastic = short_column.functions({2, column_density, elastic}).body_force({x, 0, 0}, t)[0];
  const double of_soil = short_column.functions({2, column_density, soil}).body_force({x, 0, 0}, t)[0];

  const BodyFunctions column = short_column.functions({2, column_density, elastic});
  const auto elastic_stress = [&](double stretch) { return (K + 4.0 / 3.0 * G) * std::log(stretch); };
  // Beyond yield the pressure still is K times the compaction, and sqrt(J2) what the cone lets it be.
  const auto soil_stress = [&](double stretch) {
    const double p = -K * std::log(stretch);
    const double sqrt_j2 = std::min(2 * G / std::numbers::sqrt3 * p / K, strength + alpha * p);
    return -p - 2 / std::numbers::sqrt3 * sqrt_j2;
  };
  const double scale = K / column_density;
  CHECK(of_elastic == Approx(force_along(column, elastic_stress, x, t, 1e-3)).margin(1e-6 * scale));
  CHECK(of_soil == Approx(force_along(column, soil_stress, x, t, 1e-3)).margin(1e-6 * scale));
  CHECK(std::abs(of_elastic) > 1e-3 * scale);
  // All these points have yielded.
  CHECK(std::abs(of_soil - of_elastic) > 1e-3 * scale);
}

TEST_CASE("the body force of a column of sand is what its own stress needs")
{
  TabularCapParameters parameters =
      concrete_sand::sand(GENERATE(ElasticUpdate::state, ElasticUpdate::rate)).parameters();
  const BodyFunctions column = short_column.functions({2, column_density, TabularCap(parameters)});
  parameters.tolerance = 1e-7;
  parameters.max_substeps = 10'000;
  const TabularCap accurate_sand(parameters);
  const auto stress = [&](double stretch) { return stress_at(accurate_sand, stretch); };

  for (const double x : {0.06, 0.15, 0.26}) {
    const double force = column.body_force({x, 0, 0}, 2.5e-3)[0];

    CHECK(force == Approx(force_along(column, stress, x, 2.5e-3, 1e-4)).epsilon(1e-3));
    CHECK(std::abs(force) > 1e3);
  }
}

TEST_CASE("a column is compacted at its foot, free at its end, and at rest in the end")
{
  const BodyFunctions column = short_column.functions({2, column_density, Hypoelastic{4e8, 3e8}});
  const auto u = [&](double x, double t) { return column.exact_displacement({x, 0, 0}, t)[0]; };
  const auto strain = [&](double x, double t) { return test::slope([&](double s) { return u(s, t); }, x, 1e-4); };

  CHECK(u(0.3, 0) == 0);
  CHECK(column.velocity({0.3, 0, 0}).norm() == 0);
  CHECK(std::abs(test::slope([&](double t) { return u(0.3, t); }, 0, 1e-6)) < 1e-6);
  CHECK(u(0, 3e-3) == 0);
  CHECK(strain(0, 4e-3) == Approx(-0.2));
  CHECK(std::abs(strain(0.4, 4e-3)) < 1e-9);
  CHECK(u(0.4, 4e-3) == Approx(-0.04));
  CHECK(u(0.4, 9e-3) == u(0.4, 4e-3));
}

}  // namespace test_compacted_column
