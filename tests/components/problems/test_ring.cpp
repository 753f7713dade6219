#include "components/problems/ring.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"
#include "tests/components/problems/force_needed.hpp"

namespace test_ring
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// As published, off the origin: E = 1e7, so that its motion has a period of 0.02 s.
constexpr double ring_density = 1000;
const NeoHookeanLog without_poisson_ratio{1e7 / 3, 5e6};
const Ring published_ring{.centre = {1, 2, 0}, .inner_radius = 0.4, .outer_radius = 0.6, .amplitude = 0.1};

Vector<3> at_radius(double radius, double angle)
{
  return published_ring.centre + radius * Vector<3>(std::cos(angle), std::sin(angle), 0);
}

}  // namespace

TEST_CASE("the body force of the ring is what it needs to move as the exact solution")
{
  const BodyFunctions ring = published_ring.functions({2, ring_density, without_poisson_ratio});
  const double angle = GENERATE(0.3, 2.0, 4.5), t = GENERATE(0.003, 0.011, 0.0155);
  for (const double radius : {0.405, 0.47, 0.5, 0.56, 0.595}) {
    const Vector<3> X = at_radius(radius, angle);

    const Vector<2> force = ring.body_force(X, t).head<2>();

    const Vector<2> needed = test::force_needed<2>(without_poisson_ratio, ring_density, ring, X, t, 1e-5);
    REQUIRE((force - needed).norm() < 1e-6 * 1e4);
    REQUIRE(force.norm() > 1e2);
  }
}

TEST_CASE("the rims of the ring are free and move by the amplitude, which it starts for without strain")
{
  const BodyFunctions ring = published_ring.functions({2, ring_density, without_poisson_ratio});
  const double angle = GENERATE(0.3, 2.0, 4.5);
  const Vector<3> outwards(std::cos(angle), std::sin(angle), 0);

  const auto traction_at = [&](double radius, double t) {
    const Vector<3> X = at_radius(radius, angle);
    return (test::nominal_stress<2>(without_poisson_ratio, ring, X, t) * outwards.head<2>()).norm();
  };
  // A quarter of the period is 0.005 s.
  CHECK(ring.exact_displacement(at_radius(0.6, angle), 0.005).isApprox(0.1 * outwards, 1e-12));
  CHECK(traction_at(0.4, 0.005) < 1e-3);
  CHECK(traction_at(0.6, 0.005) < 1e-3);
  CHECK(traction_at(0.5, 0.005) > 1e5);
  const Vector<3> X = at_radius(0.55, angle);
  const auto in_time = [&](double t) { return ring.exact_displacement(X, t); };
  CHECK(in_time(0).norm() == 0);
  CHECK((ring.velocity(X) - test::slope(in_time, 0, 1e-5)).norm() < 1e-8 * ring.velocity(X).norm());
  CHECK(ring.velocity(X).norm() > 10);
  CHECK(ring.layout.has_value());
}

TEST_CASE("a ring that its solution does not hold for is refused")
{
  const auto with = [](auto change, const MaterialModel& material = without_poisson_ratio) {
    Ring ring = published_ring;
    change(ring);
    return ring.functions({2, ring_density, material});
  };
  const auto nothing = [](Ring&) {};

  CHECK_THROWS_AS(with(nothing, NeoHookean{1e7 / 3, 5e6}), BadValue);
  CHECK_THROWS_AS(with(nothing, NeoHookeanLog{4e6, 5e6}), BadValue);
  CHECK_THROWS_AS(published_ring.functions({3, ring_density, without_poisson_ratio}), BadValue);
  CHECK_THROWS_AS(with([](Ring& ring) { ring.inner_radius = 0.6; }), BadParameter);
  CHECK_THROWS_AS(with([](Ring& ring) { ring.inner_radius = 0.2, ring.outer_radius = 3 * 0.2; }), BadParameter);
  // At the inner rim u / R is 2.593 amplitudes.
  CHECK_THROWS_AS(with([](Ring& ring) { ring.amplitude = 0.386; }), BadParameter);
  CHECK_NOTHROW(with([](Ring& ring) { ring.amplitude = 0.385; }));
  CHECK(!with([](Ring& ring) { ring.on_rings = false; }).layout);
}

}  // namespace test_ring
