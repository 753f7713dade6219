#include "components/curves/monotone_cubic.hpp"

#include <catch2/catch.hpp>

namespace test_monotone_cubic
{

using tamp::components::MonotoneCubic;

TEST_CASE("a monotone cubic does not overshoot its points where a plain spline would")
{
  const MonotoneCubic curve({0, 1, 2, 3, 4}, {0, 0.1, 0.2, 10, 10.1});

  double before = curve.at(0).value;
  for (int i = 1; i <= 400; ++i) {
    const double now = curve.at(0.01 * i).value;
    REQUIRE(now >= before);
    before = now;
  }
  CHECK(curve.at(2).value == Approx(0.2));
}

TEST_CASE("a monotone cubic's slope is the derivative of its value")
{
  const MonotoneCubic curve({0, 1, 2.5, 3}, {0, 2, 3, 8});

  for (double x : {-1.0, 0.3, 1.7, 2.9, 4.0}) {
    const double difference = (curve.at(x + 1e-6).value - curve.at(x - 1e-6).value) / 2e-6;
    CHECK(curve.at(x).slope == Approx(difference).epsilon(1e-7));
  }
}

}  // namespace test_monotone_cubic
