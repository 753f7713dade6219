#include "components/problems/axis_aligned.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "components/errors.hpp"
#include "tests/components/problems/force_needed.hpp"

namespace test_axis_aligned
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double K = 8333, G = 3846, density = 1.3;
const NeoHookean solid{K, G};

/// As in the literature, but for the place: the unit cube, strains up to 0.16.
AxisAligned problem_of(int n_axes)
{
  return {.amplitude = 0.05, .length = 1, .n_axes = n_axes, .origin = {0.3, -0.2, 0.1}};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the axis-aligned body force is what a neo-Hookean solid needs to move as the exact solution",
                       "", ((int D, class Solid), D, Solid), (2, NeoHookean), (3, NeoHookean), (2, NeoHookeanLog),
                       (3, NeoHookeanLog))
{
  const Solid model{K, G};
  const int n_axes = GENERATE(range(1, D + 1));
  const AxisAligned problem = problem_of(n_axes);
  const BodyFunctions functions = problem.functions({D, density, model});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  double largest = 0;
  for (int sample = 0; sample < 40; ++sample) {
    const Vector<3> X = problem.origin + Vector<3>(uniform(random), uniform(random), D == 3 ? uniform(random) : 0.0);
    const double t = 0.02 * uniform(random);

    const Vector<D> force = functions.body_force(X, t).template head<D>();

    const Vector<D> needed = test::force_needed<D>(model, density, functions, X, t, 1e-5);
    // (pi / L)^2 A E / density is what the acceleration comes to.
    const double scale = 9.87 * 0.05 * 1e4 / density;
    REQUIRE((force - needed).norm() < 1e-5 * scale);
    largest = std::max(largest, force.norm());
  }
  CHECK(largest > 500);
}

TEST_CASE("the axis-aligned solution starts where its displacement, deformation and velocity say")
{
  const AxisAligned problem = problem_of(3);
  const BodyFunctions functions = problem.functions({3, density, solid});
  const Vector<3> X(0.55, 0.15, 0.8);

  const auto in_time = [&](double t) { return functions.exact_displacement(X, t); };
  CHECK((functions.displacement(X) - in_time(0)).norm() < 1e-15);
  CHECK((functions.deformation_gradient(X) - test::differenced_gradient<3>(functions, X, 0)).norm() < 1e-9);
  CHECK((functions.velocity(X) - test::slope(in_time, 0, 1e-5)).norm() < 1e-8 * functions.velocity(X).norm());
  // The second axis starts displaced; the walls hold what is on them.
  CHECK(functions.displacement(X)[1] == Approx(0.05 * std::sin(3.14159265358979 * 0.35) * std::sqrt(0.75)));
  CHECK(std::abs(functions.exact_displacement(problem.origin, 0.003).norm()) < 1e-16);
}

TEST_CASE("the axis-aligned solution is refused for what it is not made for")
{
  CHECK_THROWS_AS(problem_of(2).functions({2, density, Hypoelastic{K, G}}), BadValue);
  CHECK_THROWS_AS(problem_of(3).functions({2, density, solid}), BadParameter);
  CHECK_THROWS_AS((AxisAligned{.amplitude = 0.32, .length = 1, .n_axes = 1}.functions({2, density, solid})),
                  BadParameter);
  CHECK_NOTHROW(AxisAligned{.amplitude = 0.31, .length = 1, .n_axes = 1}.functions({2, density, solid}));
}

}  // namespace test_axis_aligned
