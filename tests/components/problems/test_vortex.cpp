#include "components/problems/vortex.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"
#include "tests/components/problems/force_needed.hpp"

namespace test_vortex
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// As published (E = 1e3, Poisson's ratio 0.3), off the origin and moving along.
constexpr double vortex_density = 1000;
const NeoHookeanLog soft_log{1e3 / 1.2, 1e3 / 2.6};
const Vortex moving_vortex{.centre = {1, 2, 0},
                           .inner_radius = 0.75,
                           .outer_radius = 1.25,
                           .angle = 1,
                           .period = 2,
                           .velocity = {0.3, -0.2, 0}};

Vector<3> in_vortex(double radius, double angle)
{
  return moving_vortex.centre + radius * Vector<3>(std::cos(angle), std::sin(angle), 0);
}

}  // namespace

TEST_CASE("the body force of the vortex is what it needs to move as the exact solution")
{
  const BodyFunctions vortex = moving_vortex.functions({2, vortex_density, soft_log});
  const double angle = GENERATE(0.3, 2.0, 4.5), t = GENERATE(0.0, 0.5, 1.3);
  for (const double radius : {0.76, 0.9, 1.0, 1.13, 1.24}) {
    const Vector<3> X = in_vortex(radius, angle);

    const Vector<2> force = vortex.body_force(X, t).head<2>();

    const Vector<2> needed = test::force_needed<2>(soft_log, vortex_density, vortex, X, t, 1e-3);
    REQUIRE((force - needed).norm() < 1e-5);
    if (radius > 0.8 && radius < 1.2) REQUIRE(force.norm() > 0.1);
  }
}

TEST_CASE("circles of the vortex turn by their angles, and its rims are at rest and free")
{
  Vortex at_rest = moving_vortex;
  at_rest.velocity.setZero();
  const BodyFunctions vortex = at_rest.functions({2, vortex_density, soft_log});
  const double angle = GENERATE(0.3, 2.0, 4.5);

  // After a quarter of the period the circle in the middle has turned by a radian, and the rims have not.
  const Vector<3> turned = in_vortex(1, angle) + vortex.exact_displacement(in_vortex(1, angle), 0.5);
  CHECK(turned.isApprox(in_vortex(1, angle + 1), 1e-14));
  for (const double rim : {0.75, 1.25}) {
    const Vector<3> X = in_vortex(rim, angle);
    const Vector<2> outwards(std::cos(angle), std::sin(angle));
    CHECK(vortex.exact_displacement(X, 0.5).norm() < 1e-14);
    // To the error of the differences.
    CHECK((test::nominal_stress<2>(soft_log, vortex, X, 0.5) * outwards).norm() < 1e-6 * soft_log.shear_modulus);
  }
  CHECK(test::nominal_stress<2>(soft_log, vortex, in_vortex(0.85, angle), 0.5).norm() > 1e3);
}

TEST_CASE("the vortex starts where its displacement and velocity say, and moves along")
{
  const BodyFunctions vortex = moving_vortex.functions({2, vortex_density, soft_log});
  const Vector<3> X = in_vortex(0.9, 1.2);

  const auto in_time = [&](double t) { return vortex.exact_displacement(X, t); };
  CHECK(in_time(0).norm() == 0);
  CHECK((vortex.velocity(X) - test::slope(in_time, 0, 1e-3)).norm() < 1e-9);
  CHECK(in_time(2).isApprox(2 * moving_vortex.velocity, 1e-13));
  CHECK(vortex.layout.has_value());
}

TEST_CASE("a vortex that its solution does not hold for is refused")
{
  CHECK_THROWS_AS(moving_vortex.functions({2, vortex_density, NeoHookean{1e3, 4e2}}), BadValue);
  CHECK_THROWS_AS(moving_vortex.functions({3, vortex_density, soft_log}), BadValue);
  Vortex thin = moving_vortex, in_lattice = moving_vortex;
  thin.inner_radius = 1.25;
  in_lattice.on_rings = false;
  CHECK_THROWS_AS(thin.functions({2, vortex_density, soft_log}), BadParameter);
  const BodyFunctions functions = in_lattice.functions({2, vortex_density, soft_log});
  CHECK(!functions.layout);
  CHECK(functions.holds(in_vortex(1.2, 3)));
  CHECK(!functions.holds(in_vortex(0.7, 3)));
  CHECK(!functions.holds(in_vortex(1.3, 3)));
}

}  // namespace test_vortex
