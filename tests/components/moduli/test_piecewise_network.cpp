#include "components/moduli/piecewise_network.hpp"

#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>
#include <vector>

#include "tests/components/moduli/random_network.hpp"

namespace test_piecewise_network
{

using tamp::components::Activation;
using tamp::components::DenseLayer;
using tamp::components::DenseNetwork;
using tamp::components::PiecewiseNetwork;

namespace
{

constexpr std::array<double, 2> low{-2, -1}, high{1, 3};

/// Calls visit(first, second) for points of the rectangle, its corners and edges among them.
template <class Visit>
void for_points(const Visit& visit)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> first(low[0], high[0]), second(low[1], high[1]);
  for (const double x : {low[0], 0.0, high[0]}) {
    for (const double y : {low[1], 0.0, high[1]}) visit(x, y);
  }
  for (int i = 0; i < 20'000; ++i) {
    const double x = first(random), y = second(random);
    visit(x, y);
  }
}

void check_is_the_network(const std::vector<DenseLayer>& layers)
{
  const DenseNetwork plain(layers);
  const PiecewiseNetwork network(layers, low, high);

  double worst = 0, worst_slope = 0;
  int n_apart = 0;
  for_points([&](double first, double second) {
    const auto found = network.with_gradient(first, second), expected = plain.with_gradient(first, second);
    worst = std::max(worst, std::abs(network.value(first, second) - expected.value));
    worst = std::max(worst, std::abs(found.value - expected.value));
    // On a kink, which round-off may move across the point, there are two slopes.
    const double apart = std::abs(found.by_first - expected.by_first) + std::abs(found.by_second - expected.by_second);
    if (apart > 1e-9) ++n_apart;
    worst_slope = std::max(worst_slope, apart > 1e-9 ? 0 : apart);
  });
  CHECK(worst < 2e-14);
  CHECK(worst_slope < 1e-12);
  CHECK(n_apart <= 9);
}

}  // namespace

TEST_CASE("a network of relu and linear neurons answers piece by piece what its sums do")
{
  for (const auto& widths : std::vector<std::vector<std::size_t>>{{2, 1}, {2, 5, 1}, {2, 64, 1}, {2, 24, 16, 1}}) {
    check_is_the_network(random_network::layers(widths, Activation::relu, Activation::linear));
    check_is_the_network(random_network::layers(widths, Activation::relu, Activation::relu));
  }
  check_is_the_network(random_network::layers({2, 7, 7, 1}, Activation::linear, Activation::linear));
}

TEST_CASE("where many neurons switch at one point, or bend, the network itself is asked")
{
  // Forty kinks through one point of the rectangle, 16 squares to the right of its corner and 16 up.
  std::vector<DenseLayer> star = random_network::layers({2, 40, 1}, Activation::relu, Activation::linear);
  for (std::size_t o = 0; o < 40; ++o) {
    star[0].bias[o] = -(star[0].kernel[o] * (low[0] + 0.75) + star[0].kernel[40 + o] * (low[1] + 1.0));
  }
  check_is_the_network(star);
  check_is_the_network(random_network::layers({2, 6, 5, 1}, Activation::tanh, Activation::linear));
  check_is_the_network(random_network::layers({2, 6, 5, 1}, Activation::relu, Activation::sigmoid));
}

TEST_CASE("a kink is where a neuron switches and nowhere else")
{
  // |first - 0.3| + 2 second
  const PiecewiseNetwork network(std::vector<DenseLayer>{{Activation::relu, 2, 3, {1, -1, 0, 0, 0, 1}, {-0.3, 0.3, 1}},
                                                         {Activation::linear, 3, 1, {1, 1, 2}, {-2}}},
                                 low, high);

  for (const double first : {-2.0, 0.1, 0.3 - 1e-9, 0.3, 0.3 + 1e-9, 0.7, 1.0}) {
    for (const double second : {-1.0, 0.25, 3.0}) {
      CHECK(network.value(first, second) == Approx(std::abs(first - 0.3) + 2 * second).epsilon(1e-14).margin(1e-14));
    }
  }
}

}  // namespace test_piecewise_network
