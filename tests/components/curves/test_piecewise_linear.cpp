#include "components/curves/piecewise_linear.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "components/errors.hpp"

namespace test_piecewise_linear
{

using tamp::components::BadValue;
using tamp::components::PiecewiseLinear;

namespace
{

std::ptrdiff_t row_of_bad_value(std::vector<double> x, std::vector<double> y)
{
  try {
    PiecewiseLinear(std::move(x), std::move(y));
  } catch (const BadValue& bad) {
    return bad.row;
  }
  return -2;
}

}  // namespace

TEST_CASE("a tabulated curve passes through its points and is straight between and beyond them")
{
  const PiecewiseLinear curve({0, 1, 4}, {10, 12, 0});

  CHECK(curve(0) == 10);
  CHECK(curve(1) == 12);
  CHECK(curve(4) == Approx(0).margin(1e-14));
  CHECK(curve(2.5) == Approx(6));
  CHECK(curve(-1) == Approx(8));
  CHECK(curve(5) == Approx(-4));
  CHECK(curve.at(1.0).slope == -4);
  CHECK(curve.at(4.0).slope == -4);
  CHECK(curve.segment_of(4) == 1);
}

namespace
{

struct Points {
  std::vector<double> x, y;
};

/// Evenly spread, spread over many decades, and with two points so close that no table of buckets tells them apart.
Points spread(int which)
{
  Points points;
  for (int i = 0; i < 300; ++i) {
    points.x.push_back(which == 0 ? i : std::pow(1.09, i) + (i % 3) * 1e-3);
    points.y.push_back(std::sin(0.1 * i) * points.x.back());
  }
  if (which == 2) {
    points.x.insert(points.x.begin() + 150, std::nextafter(points.x[149], 1e300));
    points.y.insert(points.y.begin() + 150, points.y[149]);
  }
  return points;
}

}  // namespace

TEST_CASE("a tabulated curve finds the segment a plain search finds, however unevenly the points lie")
{
  const auto points = spread(GENERATE(0, 1, 2));
  const auto& x = points.x;
  const auto& y = points.y;
  const PiecewiseLinear curve(x, y);
  const auto check = [&](double at) {
    std::size_t segment = 0;
    while (segment + 2 < x.size() && x[segment + 1] <= at) ++segment;
    const double slope = (y[segment + 1] - y[segment]) / (x[segment + 1] - x[segment]);
    REQUIRE(curve.segment_of(at) == segment);
    REQUIRE(curve.at(at).slope == slope);
    REQUIRE(curve.at(at).value == Approx(y[segment] + slope * (at - x[segment])).epsilon(1e-12).margin(1e-12));
  };

  for (int k = -10; k < 30000; ++k) check(0.5 + x.back() * 1.01 * std::pow(k / 30000.0, 5));
  for (double at : x) check(at);
}

TEST_CASE("in lanes a tabulated curve gives the bits that it gives one number")
{
  const auto [x, y] = spread(GENERATE(0, 1, 2));
  const PiecewiseLinear curve(x, y);
  std::vector<double> places{-1e300, -1, 0, 1e300, std::numeric_limits<double>::infinity()};
  for (double at : x) places.insert(places.end(), {at, std::nextafter(at, -1e300), std::nextafter(at, 1e300)});

  for (std::size_t i = 0; i + tamp::n_lanes <= places.size(); ++i) {
    const auto lanes = curve.at(tamp::each_lane([&](std::size_t l) { return places[i + l]; }));
    for (std::size_t l = 0; l < tamp::n_lanes; ++l) {
      const auto one = curve.at(places[i + l]);
      const bool same =
          lanes.value[l] == one.value && lanes.slope[l] == one.slope && lanes.from_kink[l] == one.from_kink;
      REQUIRE((same || std::isinf(places[i + l])));
    }
  }
}

TEST_CASE("a tabulated curve knows how far it is from an inner point nearby")
{
  const PiecewiseLinear curve({0, 1, 4, 9}, {10, 12, 0, 5});
  CHECK(curve.at(1.0).from_kink == 0);
  CHECK(curve.at(1 + 1e-9).from_kink == Approx(1e-9));
  CHECK(curve.at(4 - 1e-9).from_kink == Approx(-1e-9));
  CHECK(curve.slopes_beside_kink(4) == std::pair(-4.0, 1.0));
}

TEST_CASE("a table that does not ascend is refused with its row")
{
  CHECK(row_of_bad_value({0, 1, 1, 2}, {0, 1, 2, 3}) == 2);
  CHECK(row_of_bad_value({0, 1, 2, 1.5}, {0, 1, 2, 3}) == 3);
  CHECK(row_of_bad_value({0, 1, 2}, {0, NAN, 2}) == 1);
  CHECK(row_of_bad_value({0}, {0}) == -1);
  CHECK(row_of_bad_value({0, 1}, {0}) == -1);
}

}  // namespace test_piecewise_linear
