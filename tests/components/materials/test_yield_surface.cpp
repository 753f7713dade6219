#include "components/materials/yield_surface.hpp"

#include <catch2/catch.hpp>

#include "components/errors.hpp"
#include "tests/components/materials/concrete_sand.hpp"

namespace test_yield_surface
{

using tamp::components::BadValue;
using tamp::components::YieldSurface;

TEST_CASE("the yield envelope is concave and lies on or above every measured point")
{
  const auto rows = concrete_sand::columns("yield_sqrt_J2.csv");
  const YieldSurface surface = concrete_sand::yield_surface();

  for (std::size_t i = 0; i < rows[0].size(); ++i) {
    REQUIRE(surface.strength(rows[0][i]).value >= rows[1][i] * (1 - 1e-12));
  }
  for (std::size_t i = 1; i < surface.hull().n_segments(); ++i) {
    REQUIRE(surface.hull().slope_of_segment(i) < surface.hull().slope_of_segment(i - 1));
  }
  CHECK(surface.vertex_pressure() == -24.5e3);
  CHECK(surface.strength(-24.5e3).value == 0);
  CHECK(surface.strength(-1e6).value == 0);
}

TEST_CASE("the cap joins the cone with equal slope and closes at the crush pressure")
{
  const YieldSurface surface(std::vector<double>{-1, 9, 49}, std::vector<double>{0, 10, 20}, 0.7);
  const double crush = 19, kappa = -1 + 0.7 * 20;

  CHECK(surface.limit(kappa, crush) == surface.strength(kappa).value);
  CHECK(surface.limit(kappa + 1e-4, crush) == Approx(surface.strength(kappa + 1e-4).value).epsilon(1e-9));
  CHECK(surface.limit(16.0, crush) == Approx(surface.strength(16.0).value * std::sqrt(0.75)));
  CHECK(surface.limit(crush, crush) == 0);
  CHECK(surface.limit(25.0, crush) == 0);
}

TEST_CASE("a yield table without a vertex, or with a strength that is no number, is refused with its row")
{
  const std::vector<double> pressure{-1, 1, 2};
  const auto row = [&](const std::vector<double>& strength, double ellipticity) {
    try {
      YieldSurface(pressure, strength, ellipticity);
    } catch (const BadValue& bad) {
      return bad.row;
    }
    return std::ptrdiff_t{-2};
  };

  CHECK(row({0.1, 1, 2}, 0.7) == 0);
  CHECK(row({0, -1, 2}, 0.7) == 1);
  CHECK(row({0, 2, 1}, 0.7) == 2);
  CHECK(row({0, 1, 2}, 1) == -1);
  CHECK(row({0, 1, 2}, 0.7) == -2);
}

}  // namespace test_yield_surface
