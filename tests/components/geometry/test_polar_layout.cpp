#include "components/geometry/polar_layout.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

namespace test_polar_layout
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a polar layout fills its ring, and is as round as one")
{
  const double inner = GENERATE(0.0, 0.37);
  const PolarLayout layout{{0.2, -0.1}, inner, 0.8};

  const auto sites = layout.sites(GENERATE(0.013, 0.1, 3.0), false);

  double volume = 0;
  Vector<2> moment = Vector<2>::Zero();
  for (const Site<2>& site : sites) {
    const Vector<2> arm = site.place - layout.centre;
    REQUIRE((arm.norm() > inner && arm.norm() < 0.8));
    volume += site.volume;
    moment += site.volume * arm;
  }
  CHECK(volume == Approx(std::numbers::pi * (0.64 - inner * inner)).epsilon(1e-13));
  CHECK(moment.norm() < 1e-13 * volume);
}

TEST_CASE("half of a polar layout about the axis fills a ball, and a quarter half of it")
{
  constexpr double inf = std::numeric_limits<double>::infinity();
  const double spacing = GENERATE(0.013, 0.1, 3.0), lowest = GENERATE(-inf, 0.3);
  const PolarLayout layout{{0, 0.3}, 0, 0.8, Box<2>{{0, lowest}, {inf, inf}}};

  double volume = 0, area = 0;
  for (const Site<2>& site : layout.sites(spacing, true)) volume += site.volume;
  for (const Site<2>& site : layout.sites(spacing, false)) area += site.volume;

  const double part = lowest == 0.3 ? 0.5 : 1;
  CHECK(volume == Approx(part * 4 / 3 * std::numbers::pi * 0.512).epsilon(1e-13));
  CHECK(area == Approx(part / 2 * std::numbers::pi * 0.64).epsilon(1e-13));
}

TEST_CASE("rings whose centre is off the axis have the volume of a torus")
{
  double volume = 0;
  for (const Site<2>& site : PolarLayout{{2, 0}, 0.3, 0.8}.sites(0.1, true)) volume += site.volume;

  CHECK(volume == Approx(2 * std::numbers::pi * 2 * std::numbers::pi * (0.64 - 0.09)).epsilon(1e-13));
}

TEST_CASE("a polar layout's rings are as wide as the spacing, and its sectors about as long")
{
  const PolarLayout layout{{0, 0}, 1, 2};

  const auto sites = layout.sites(0.26, false);

  // Four rings of 0.25; round the first, at 1.125, go 28.3 of them.
  CHECK(sites[0].place.norm() == Approx(1.125));
  CHECK(sites[28].place.norm() == Approx(1.375));
  CHECK((sites[1].place - sites[0].place).norm() == Approx(2 * 1.125 * std::sin(std::numbers::pi / 28)));
  CHECK(sites.back().place.norm() == Approx(1.875));
  CHECK(sites[0].volume == Approx(0.25 * 2 * std::numbers::pi * 1.125 / 28));
}

TEST_CASE("a ring thinner than the spacing is one ring of particles")
{
  CHECK(PolarLayout{{0, 0}, 1, 1.01}.sites(0.1, false).front().place.norm() == Approx(1.005));
  CHECK(PolarLayout{{0, 0}, 0, 0.01}.sites(0.1, false).size() == 3);
}

TEST_CASE("a sector lies outwards and around")
{
  const Matrix<2> axes = PolarLayout{{0.2, -0.1}, 0, 1}.axes_at({0.2, 0.4});

  CHECK((axes.col(0) - Vector<2>(0, 1)).norm() < 1e-15);
  CHECK((axes.col(1) - Vector<2>(-1, 0)).norm() < 1e-15);
}

}  // namespace test_polar_layout
