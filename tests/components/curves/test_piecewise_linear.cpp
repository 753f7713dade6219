#include "components/curves/piecewise_linear.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"

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
  CHECK(curve.at(1).slope == -4);
  CHECK(curve.at(4).segment == 1);
}

TEST_CASE("a tabulated curve finds the segment a plain search finds, however unevenly the points lie")
{
  std::vector<double> x, y;
  for (int i = 0; i < 300; ++i) {
    x.push_back(std::pow(1.09, i) + (i % 3) * 1e-3);
    y.push_back(i);
  }
  const PiecewiseLinear curve(x, y);

  for (int k = -10; k < 30000; ++k) {
    const double at = 0.5 + x.back() * 1.01 * std::pow(k / 30000.0, 5);
    std::size_t segment = 0;
    while (segment + 2 < x.size() && x[segment + 1] <= at) ++segment;
    REQUIRE(curve.at(at).segment == segment);
  }
  for (std::size_t i = 0; i + 1 < x.size(); ++i) REQUIRE(curve.at(x[i]).segment == i);
}

TEST_CASE("a table that does not ascend is refused with its row")
{
  CHECK(row_of_bad_value({0, 1, 1, 2}, {0, 1, 2, 3}) == 2);
  CHECK(row_of_bad_value({0, 1, 2, 1.5}, {0, 1, 2, 3}) == 3);
  CHECK(row_of_bad_value({0, 1, 2}, {0, NAN, 2}) == 1);
  CHECK(row_of_bad_value({0}, {0}) == -1);
  CHECK(row_of_bad_value({0, 1}, {0}) == -1);
}
