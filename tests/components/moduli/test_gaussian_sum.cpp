#include "components/moduli/gaussian_sum.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace test_gaussian_sum
{

using tamp::components::Gaussians;
using tamp::components::GaussianSum;

namespace
{

GaussianSum::Values<double> plain(const Gaussians& gaussians, double x, double y)
{
  const long double a = 2 * gaussians.sharpness_x, b = 2 * gaussians.sharpness_y;
  long double f = 0, by_x = 0, by_y = 0, by_xx = 0, by_xy = 0;
  for (const auto& peak : gaussians.peaks) {
    const long double dx = peak.x - x, dy = peak.y - y;
    const long double g = peak.weight * std::exp(-0.5L * (a * dx * dx + b * dy * dy));
    f += g;
    by_x += a * dx * g;
    by_y += b * dy * g;
    by_xx += (a * dx * a * dx - a) * g;
    by_xy += a * dx * b * dy * g;
  }
  const auto rounded = [](long double value) { return static_cast<double>(value); };
  return {rounded(f), rounded(by_x), rounded(by_y), rounded(by_xx), rounded(by_xy)};
}

// A peak in the rectangle (1 to 3, 0 to 2), one at its corner, one far away.
const Gaussians three_peaks{5, 2, {{1.7, 0.4, 3}, {3, 2, -1}, {-4, 1, 1000}}};

}  // namespace

TEST_CASE("a sum of Gaussians and its derivatives are those of each Gaussian, added up")
{
  const GaussianSum sum(three_peaks, {1, 3}, {0, 2});

  for (int i = 0; i <= 50; ++i) {
    for (int j = 0; j <= 50; ++j) {
      const double x = 1 + 0.04 * i, y = 0.04 * j;
      const GaussianSum::Values<double> fast = sum.at(x, y), slow = plain(three_peaks, x, y);
      REQUIRE(std::abs(fast.f - slow.f) < 5e-15);
      REQUIRE(std::abs(fast.by_x - slow.by_x) < 5e-14);
      REQUIRE(std::abs(fast.by_y - slow.by_y) < 5e-14);
      REQUIRE(std::abs(fast.by_xx - slow.by_xx) < 3e-11);  // eight terms in x: 1e-12 of 2 sharpness weight
      REQUIRE(std::abs(fast.by_xy - slow.by_xy) < 2e-12);
    }
  }
}

TEST_CASE("what is subtracted on the diagonal changes a sum of Gaussians by the same all along x")
{
  GaussianSum sum(three_peaks, {1, 3}, {0, 2});

  sum.subtract_diagonal(three_peaks);

  for (const double y : {0.0, 0.3, 1.1, 2.0}) {
    const GaussianSum::Values<double> diagonal = plain(three_peaks, y, y);
    for (const double x : {1.0, 1.6, 3.0}) {
      const GaussianSum::Values<double> fast = sum.at(x, y), slow = plain(three_peaks, x, y);
      CHECK(std::abs(fast.f - (slow.f - diagonal.f)) < 1e-14);
      CHECK(std::abs(fast.by_x - slow.by_x) < 5e-14);
      CHECK(std::abs(fast.by_y - (slow.by_y - diagonal.by_x - diagonal.by_y)) < 5e-14);
    }
  }
}

}  // namespace test_gaussian_sum
