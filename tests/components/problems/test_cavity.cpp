#include "components/problems/cavity.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/components/materials/concrete_sand.hpp"
#include "tests/components/problems/force_needed.hpp"

namespace test_cavity
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double ground_density = 1624, duration = 4e-3;

Cavity cavity(double shortening)
{
  return {.centre = {0.1, -0.2, 0},
          .inner_radius = 0.2,
          .outer_radius = 0.5,
          .expansion = 0.3,
          .shortening = shortening,
          .duration = duration};
}

/// At a distance from the centre, along a slant.
Vector<3> place(double radius)
{
  return {0.1 + 0.6 * radius, -0.2 + 0.8 * radius, 0};
}

double outwards(const Vector<3>& v)
{
  return 0.6 * v[0] + 0.8 * v[1];
}

}  // namespace

TEST_CASE("a cavity widens by the part asked for, compacts as asked for, and is at rest before and after")
{
  const BodyFunctions ring = cavity(2).functions({2, ground_density, Hypoelastic{4e8, 3e8}});
  const auto u = [&](double radius, double t) { return outwards(ring.exact_displacement(place(radius), t)); };

  CHECK(u(0.2, 0) == Approx(0).margin(1e-15));
  CHECK(u(0.2, duration) == Approx(0.06));
  CHECK(u(0.2, 2 * duration) == u(0.2, duration));
  CHECK(ring.velocity(place(0.2)).norm() == 0);
  CHECK(std::abs(test::slope([&](double t) { return u(0.2, t); }, 0, 1e-6)) < 1e-6);
  for (const double radius : {0.22, 0.3, 0.5}) {
    const Matrix<2> f = test::differenced_gradient<2>(ring, place(radius), 3e-3);
    CHECK(f.determinant() == Approx(radius / (radius + u(radius, 3e-3))).epsilon(1e-8));
  }
}

TEST_CASE("body force and pressures of a cavity are what its stress needs")
{
  const double shortening = GENERATE(1.0, 2.0), t = GENERATE(1.3e-3, 3e-3);
  const NeoHookeanLog solid{4e8, 3e8};
  const BodyFunctions ring = cavity(shortening).functions({2, ground_density, solid});

  for (const double radius : {0.22, 0.3, 0.45}) {
    const Vector<2> needed = test::force_needed<2>(solid, ground_density, ring, place(radius), t, 1e-5);
    const Vector<2> force = ring.body_force(place(radius), t).head<2>();
    CHECK((force - needed).norm() < 1e-5 * needed.norm());
    CHECK(needed.norm() > 1e3);
  }
  for (const double rim : {0.2, 0.5}) {
    const Matrix<2> f = test::differenced_gradient<2>(ring, place(rim), t);
    const Matrix<2> nominal = test::nominal_stress<2>(solid, ring, place(rim), t);
    const Vector<2> normal(0.6, 0.8);
    const double hoop = f.determinant() / normal.dot(f * normal);
    CHECK(ring.pressure(place(rim), t) == Approx(-normal.dot(nominal * normal) / hoop).epsilon(1e-6));
  }
}

TEST_CASE("von Mises' ground around a cavity needs 2 k / r beside its inertia, and k on its rims")
{
  // sqrt(J2) = k all through the ring at the end, and no pressure, as the volume is kept.
  const double c = 1e5, k = 2 * c / std::sqrt(3.0), t = 0.9 * duration;
  const DruckerPrager clay{.bulk_modulus = 4e8, .shear_modulus = 3e8, .friction_angle = 0, .cohesion = c};
  const BodyFunctions ring = cavity(1).functions({2, ground_density, clay});

  for (const double radius : {0.2, 0.3, 0.5}) {
    const auto r = [&](double time) { return radius + outwards(ring.exact_displacement(place(radius), time)); };
    const auto velocity = [&](double time) { return test::slope(r, time, 1e-5); };
    const double needed = test::slope(velocity, t, 1e-5) + 2 * k / (ground_density * r(t));
    CHECK(outwards(ring.body_force(place(radius), t)) == Approx(needed).epsilon(1e-6));
    CHECK(ring.pressure(place(radius), t) == Approx(k).epsilon(1e-6));
  }
}

TEST_CASE("the rim of a cavity in sand is pressed with the stress of the sand's own path")
{
  constexpr int n_steps = 2000;
  const TabularCap sand = concrete_sand::sand(ElasticUpdate::state);
  const BodyFunctions ring = cavity(2).functions({2, ground_density, sand});
  const double last = std::log(1.3);

  test::OneParticle<2, TabularCap> particle;
  for (int i = 1; i <= n_steps; ++i) {
    particle.deformation_gradient(0, 0) = std::exp(-2 * last * i / n_steps);
    particle.deformation_gradient(1, 1) = std::exp(last * i / n_steps);
    particle.strain(sand, SymmetricTensor<2>(-2 * last / n_steps, last / n_steps, 0, 0));
  }

  CHECK(ring.pressure(place(0.2), duration) == Approx(-particle.stress[0]).epsilon(1e-4));
  CHECK(particle.stress[0] < -1e7);
}

}  // namespace test_cavity
