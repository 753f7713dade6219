#include "components/materials/cap_return.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

namespace test_cap_return
{

using namespace tamp::components;

namespace
{

constexpr double bulk = 1e9, shear = 0.8e9, fixed_crush = 10e6;

YieldSurface kinked_surface()
{
  const std::vector<double> pressure{-0.1e6, 1e6, 4e6, 20e6}, strength{0, 1e6, 3e6, 6e6};
  return {pressure, strength, 0.7};
}

/// Perfect plasticity: constant moduli and cap.
struct FixedPath {
  double pressure, sqrt_j2;

  PathPoint operator()(double d) const { return {pressure - bulk * d, -bulk, fixed_crush, 0, bulk, shear, sqrt_j2}; }
};

/// Constant moduli, and a cap that hardens as it is pushed.
struct HardeningPath {
  double pressure, sqrt_j2, hardening;

  PathPoint operator()(double d) const
  {
    const double crush = fixed_crush * std::exp(hardening * d);
    return {pressure - bulk * d, -bulk, crush, hardening * crush, bulk, shear, sqrt_j2};
  }
};

/// Square of the distance in the norm of the elastic energy.
double distance(double p0, double q0, double p1, double q1)
{
  return (p1 - p0) * (p1 - p0) / bulk + (q1 - q0) * (q1 - q0) / shear;
}

/// The closest point of the surface: from many points along it, densest at its ends, then from as many about the best.
double brute_force_distance(const YieldSurface& surface, double pressure, double sqrt_j2)
{
  const double vertex = surface.vertex_pressure(), length = fixed_crush - vertex;
  double best = std::numeric_limits<double>::max(), best_angle = 0;
  constexpr int n = 5000;
  const auto search = [&](double from, double to) {
    for (int i = 0; i <= n; ++i) {
      const double angle = from + (to - from) * i / n;
      const double p = vertex + length * 0.5 * (1 - std::cos(angle));
      const double here = distance(pressure, sqrt_j2, p, surface.limit(p, fixed_crush));
      if (here < best) best = here, best_angle = angle;
    }
  };
  search(0, M_PI);
  const double about = M_PI / n;
  search(std::max(best_angle - about, 0.0), std::min(best_angle + about, M_PI));
  for (double p : surface.hull().x()) {
    if (p <= fixed_crush) best = std::min(best, distance(pressure, sqrt_j2, p, surface.limit(p, fixed_crush)));
  }
  return best;
}

}  // namespace

TEST_CASE("a trial inside the surface is left where it is")
{
  const ReturnPoint point = return_to_surface(kinked_surface(), FixedPath{2e6, 1e6});

  CHECK(point.status == ReturnStatus::elastic);
  CHECK(point.plastic_volumetric == 0);
  CHECK(point.multiplier == 0);
  CHECK(point.sqrt_j2 == 1e6);
}

TEST_CASE("perfectly plastic returns of a 30 x 30 grid of trials end at the surface's closest point")
{
  const YieldSurface surface = kinked_surface();

  for (int i = 0; i < 30; ++i) {
    for (int j = 0; j < 30; ++j) {
      const double p = -8e6 + 1e6 * i, q = 0.3e6 * j;
      const ReturnPoint point = return_to_surface(surface, FixedPath{p, q});
      CAPTURE(p, q, point.at.pressure, point.sqrt_j2, point.n_evaluations);
      REQUIRE(point.status != ReturnStatus::failed);
      if (point.status == ReturnStatus::elastic) continue;
      REQUIRE(std::abs(point.sqrt_j2 - surface.limit(point.at.pressure, fixed_crush)) <= 1e-8 * fixed_crush);
      REQUIRE(point.at.pressure >= surface.vertex_pressure() - 1e-3);
      REQUIRE(point.at.pressure <= fixed_crush * (1 + 1e-12));
      REQUIRE(point.multiplier >= 0);
      const double found = distance(p, q, point.at.pressure, point.sqrt_j2);
      const double best = brute_force_distance(surface, p, q);
      REQUIRE(found <= best * (1 + 1e-9));
      REQUIRE(found >= best * (1 - 1e-4));
    }
  }
}

TEST_CASE("hardening returns of a 30 x 30 grid of trials meet the flow rule on the moved surface")
{
  const YieldSurface surface = kinked_surface();

  for (double hardening : {1.0, 30.0, 1000.0}) {
    for (int i = 0; i < 30; ++i) {
      for (int j = 0; j < 30; ++j) {
        const HardeningPath path{-2e6 + 0.7e6 * i, 0.25e6 * j, hardening};
        const ReturnPoint point = return_to_surface(surface, path);
        CAPTURE(path.pressure, path.sqrt_j2, hardening, point.n_evaluations);
        REQUIRE(point.status != ReturnStatus::failed);
        if (point.status == ReturnStatus::elastic) continue;
        const PathPoint there = path(point.plastic_volumetric);
        REQUIRE(point.at.pressure == Approx(there.pressure).epsilon(1e-12));
        REQUIRE(point.at.crush_pressure == Approx(there.crush_pressure).epsilon(1e-11));
        if (point.status == ReturnStatus::apex) {
          REQUIRE(there.pressure == Approx(there.crush_pressure).epsilon(1e-12));
          REQUIRE(path.sqrt_j2 == 0);
          continue;
        }
        REQUIRE(std::abs(point.sqrt_j2 - surface.limit(there.pressure, there.crush_pressure)) <=
                1e-8 * there.crush_pressure);
        if (point.status != ReturnStatus::cone_or_cap) continue;
        // d = -dl h_p with h_p between the slopes on either side.
        const double p = there.pressure,
                     step = 1e-6 * std::min(p - surface.vertex_pressure(), there.crush_pressure - p);
        const auto h = [&](double at) { return surface.limit(at, there.crush_pressure); };
        const double left = (h(p) - h(p - step)) / step, right = (h(p + step) - h(p)) / step;
        const double flow = -point.plastic_volumetric / point.multiplier;
        const double slack = 1e-4 * (1 + std::abs(left));
        REQUIRE(flow <= std::max(left, right) + slack);
        REQUIRE(flow >= std::min(left, right) - slack);
      }
    }
  }
}

TEST_CASE("on the hydrostat the cap is pushed to where pressure and crush pressure are equal")
{
  const ReturnPoint point = return_to_surface(kinked_surface(), HardeningPath{30e6, 0, 40});

  CHECK(point.status == ReturnStatus::apex);
  CHECK(point.at.pressure == Approx(point.at.crush_pressure).epsilon(1e-12));
  CHECK(point.sqrt_j2 == 0);
  CHECK(point.plastic_volumetric > 0);
}

TEST_CASE("a trial in the normal cone of the tension vertex loses all its shear there")
{
  const YieldSurface surface = kinked_surface();

  const ReturnPoint inside = return_to_surface(surface, FixedPath{-5e6, 1e6});
  const ReturnPoint outside = return_to_surface(surface, FixedPath{-0.2e6, 1e6});

  CHECK(inside.status == ReturnStatus::tension_vertex);
  CHECK(inside.at.pressure == Approx(surface.vertex_pressure()));
  CHECK(inside.sqrt_j2 == 0);
  CHECK(inside.plastic_volumetric < 0);
  CHECK(outside.status == ReturnStatus::cone_or_cap);
  CHECK(outside.at.pressure > surface.vertex_pressure());
}

TEST_CASE("a trial near the apex takes few evaluations however little shear it has")
{
  const YieldSurface surface = kinked_surface();

  int most = 0;
  for (double shear_part : {1e-9, 1e-6, 1e-4, 1e-2, 0.1}) {
    for (double beyond : {-1e-5, 1e-9, 1e-5, 1e-3, 0.1}) {
      const HardeningPath path{fixed_crush * (1 + beyond), fixed_crush * shear_part, 50};
      const ReturnPoint point = return_to_surface(surface, path);
      REQUIRE(point.status != ReturnStatus::failed);
      REQUIRE(std::abs(point.residual) < 1e-9);
      most = std::max(most, point.n_evaluations);
    }
  }
  CHECK(most <= 30);
}

}  // namespace test_cap_return
