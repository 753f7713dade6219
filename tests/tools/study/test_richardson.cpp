#include "tools/study/richardson.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace test_richardson
{

using namespace tamp::tools::study;

namespace
{

/// Differences between answers limit + c h^p on neighbouring grids.
std::vector<double> differences(const std::vector<double>& spacings, double c, double order)
{
  std::vector<double> found;
  for (std::size_t i = 1; i < spacings.size(); ++i) {
    found.push_back(c * (std::pow(spacings[i], order) - std::pow(spacings[i - 1], order)));
  }
  return found;
}

}  // namespace

TEST_CASE("answers with one power of the spacing give that order, and what the finest lacks")
{
  const double order = GENERATE(0.6, 1.0, 1.3, 2.0);
  const double c = GENERATE(3.0, -0.2);
  const std::vector<double> spacings = GENERATE(std::vector{0.04, 0.02, 0.01}, std::vector{0.05, 0.02, 0.01, 0.004});

  const Convergence found = convergence(spacings, differences(spacings, c, order));

  CHECK(found.falls);
  CHECK(found.order == Approx(order).epsilon(1e-6));
  CHECK(found.rest == Approx(-c * std::pow(spacings.back(), order)).epsilon(1e-6));
}

TEST_CASE("orders above 2 extrapolate no further than order 2 does")
{
  const std::vector<double> spacings{4, 2, 1}, of_two_grids = differences(spacings, 1, 4);

  const Convergence found = convergence(spacings, of_two_grids);

  CHECK(found.order == Approx(4).epsilon(1e-6));
  CHECK(found.rest == Approx(of_two_grids.back() / 3));
}

TEST_CASE("differences that do not fall, change sign or fall too slowly claim nothing")
{
  const std::vector<double> spacings{4, 2, 1};
  CHECK_FALSE(convergence(spacings, std::vector{0.3, 0.4}).falls);
  CHECK_FALSE(convergence(spacings, std::vector{0.4, 0.4}).falls);
  CHECK_FALSE(convergence(spacings, std::vector{0.4, -0.1}).falls);
  // From 8 to 2 there is more to gain than from 2 to 1: this is no power of the spacing.
  CHECK_FALSE(convergence(std::vector<double>{8, 2, 1}, std::vector{0.2, 0.19}).falls);
  CHECK(convergence(spacings, std::vector{0.3, 0.4}).note.starts_with("no bound"));
  // The last two fall, but those before them did not.
  CHECK_FALSE(convergence(std::vector<double>{8, 4, 2, 1}, std::vector{0.3, 0.4, 0.2}).falls);
}

TEST_CASE("an order so low that most is missing, two finest answers alike, and what is no number claim nothing")
{
  const std::vector<double> spacings{4, 2, 1};
  CHECK_FALSE(convergence(spacings, differences(spacings, 1, 0.4)).falls);
  CHECK_FALSE(convergence(spacings, std::vector{0.1, 0.0}).falls);
  CHECK_FALSE(convergence(spacings, std::vector{NAN, 0.1}).falls);
}

TEST_CASE("the same answer on all grids lacks nothing")
{
  const Convergence found = convergence(std::vector<double>{4, 2, 1}, std::vector<double>{0, 0});
  CHECK(found.falls);
  CHECK(found.rest == 0);
}

TEST_CASE("the fitted order is the slope of the logarithms, without errors of 0")
{
  const std::vector<double> spacings{8, 4, 2, 1};
  CHECK(fitted_order(spacings, std::vector{512.0, 64.0, 8.0, 1.0}) == Approx(3));
  CHECK(fitted_order(spacings, std::vector{64.0, 16.0, 4.0, 0.0}) == Approx(2));
  CHECK(std::isnan(fitted_order(spacings, std::vector{64.0, 16.0, 0.0, 0.0})));
}

TEST_CASE("the fitted limit leaves out what goes with the order")
{
  const std::vector<double> spacings{8, 4, 2};
  CHECK(fitted_limit(spacings, std::vector{11.0, 7.0, 5.0}, 1) == Approx(3));
  CHECK(fitted_limit(spacings, std::vector{-59.0, -11.0, 1.0}, 2) == Approx(5));
  CHECK(std::isnan(fitted_limit(std::vector{8.0, 4.0}, std::vector{11.0, 7.0}, 1)));
}

}  // namespace test_richardson
