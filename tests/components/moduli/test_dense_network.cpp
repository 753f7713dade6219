#include "components/moduli/dense_network.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "components/errors.hpp"
#include "tests/components/moduli/random_network.hpp"

namespace test_dense_network
{

using tamp::components::Activation;
using tamp::components::BadValue;
using tamp::components::DenseLayer;
using tamp::components::DenseNetwork;

namespace
{

double activated(Activation activation, double x)
{
  switch (activation) {
    case Activation::relu:
      return x > 0 ? x : 0;
    case Activation::sigmoid:
      return 1 / (1 + std::exp(-x));
    case Activation::tanh:
      return std::tanh(x);
    case Activation::linear:
      break;
  }
  return x;
}

/// By the value that the activation has.
double slope(Activation activation, double y)
{
  switch (activation) {
    case Activation::relu:
      return y > 0 ? 1 : 0;
    case Activation::sigmoid:
      return y * (1 - y);
    case Activation::tanh:
      return 1 - y * y;
    case Activation::linear:
      break;
  }
  return 1;
}

/// The plain network: one neuron after the other, and its derivatives from the output back to the inputs.
DenseNetwork::Gradient plainly(const std::vector<DenseLayer>& layers, double first, double second)
{
  std::vector<std::vector<double>> neurons{{first, second}};
  for (const DenseLayer& layer : layers) {
    std::vector<double> outputs = layer.bias;
    for (std::size_t o = 0; o < layer.n_outputs; ++o) {
      for (std::size_t i = 0; i < layer.n_inputs; ++i) {
        outputs[o] += neurons.back()[i] * layer.kernel[i * layer.n_outputs + o];
      }
      outputs[o] = activated(layer.activation, outputs[o]);
    }
    neurons.push_back(outputs);
  }
  std::vector<double> derivative{1};
  for (std::size_t l = layers.size(); l-- > 0;) {
    const DenseLayer& layer = layers[l];
    std::vector<double> by_inputs(layer.n_inputs, 0);
    for (std::size_t i = 0; i < layer.n_inputs; ++i) {
      for (std::size_t o = 0; o < layer.n_outputs; ++o) {
        by_inputs[i] +=
            layer.kernel[i * layer.n_outputs + o] * slope(layer.activation, neurons[l + 1][o]) * derivative[o];
      }
    }
    derivative = by_inputs;
  }
  return {neurons.back()[0], derivative[0], derivative[1]};
}

const std::vector<std::vector<std::size_t>> shapes{{2, 1},         {2, 5, 3, 1},       {2, 17, 33, 1},
                                                   {2, 40, 56, 1}, {2, 64, 32, 32, 1}, {2, 130, 65, 1}};
constexpr Activation activations[] = {Activation::linear, Activation::relu, Activation::sigmoid, Activation::tanh};

/// Calls visit(first, second) for points around zero.
template <class Visit>
void for_points(const Visit& visit)
{
  std::mt19937 random(7);
  std::uniform_real_distribution<double> strain(-2, 2);
  for (int i = 0; i < 50; ++i) {
    const double first = strain(random), second = strain(random);
    visit(first, second);
  }
}

std::vector<DenseLayer> valid()
{
  return random_network::layers({2, 5, 3, 1}, Activation::relu, Activation::linear);
}

}  // namespace

TEST_CASE("a dense network answers what plain sums do, whatever its shape and activation")
{
  for (const auto& shape : shapes) {
    for (const Activation activation : activations) {
      const auto layers = random_network::layers(shape, activation, activation);
      const DenseNetwork network(layers);

      for_points([&](double first, double second) {
        const double expected = plainly(layers, first, second).value;
        CHECK(network.value(first, second) == Approx(expected).epsilon(1e-13).margin(1e-13));
      });
    }
  }
}

TEST_CASE("the gradient of a dense network is that of backpropagation")
{
  for (const auto& shape : shapes) {
    for (const Activation activation : activations) {
      const auto layers = random_network::layers(shape, activation, activation);
      const DenseNetwork network(layers);

      for_points([&](double first, double second) {
        const DenseNetwork::Gradient found = network.with_gradient(first, second);
        const DenseNetwork::Gradient expected = plainly(layers, first, second);
        CHECK(found.value == Approx(expected.value).epsilon(1e-13).margin(1e-13));
        CHECK(found.by_first == Approx(expected.by_first).epsilon(1e-13).margin(1e-13));
        CHECK(found.by_second == Approx(expected.by_second).epsilon(1e-13).margin(1e-13));
      });
    }
  }
}

TEST_CASE("the gradient of a smooth network is the limit of differences")
{
  for (const Activation activation : {Activation::sigmoid, Activation::tanh}) {
    const DenseNetwork network(random_network::layers({2, 17, 33, 1}, activation, Activation::linear));
    constexpr double step = 1e-5;

    for_points([&](double first, double second) {
      const auto [value, by_first, by_second] = network.with_gradient(first, second);
      CHECK(by_first == Approx((network.value(first + step, second) - network.value(first - step, second)) / (2 * step))
                            .margin(1e-9));
      CHECK(by_second ==
            Approx((network.value(first, second + step) - network.value(first, second - step)) / (2 * step))
                .margin(1e-9));
    });
  }
}

TEST_CASE("sigmoid and tanh saturate and neither overflow nor lose small numbers")
{
  for (const Activation activation : {Activation::sigmoid, Activation::tanh}) {
    const DenseNetwork network(
        std::vector<DenseLayer>{{activation, 2, 1, {1, 0}, {0}}, {Activation::linear, 1, 1, {1}, {0}}});
    for (const double x : {-1e6, -800.0, -700.0, -40.0, -1e-3, 0.0, 1e-8, 0.5, 20.0, 709.0, 1e6}) {
      CHECK(network.value(x, 0) == Approx(activated(activation, x)).epsilon(1e-15).margin(1e-15));
      CHECK(std::isfinite(network.with_gradient(x, 0).by_first));
    }
  }
}

TEST_CASE("at the kink of relu the derivative is zero")
{
  const DenseNetwork network(
      std::vector<DenseLayer>{{Activation::relu, 2, 1, {1, 1}, {0}}, {Activation::linear, 1, 1, {3}, {5}}});

  const auto [value, by_first, by_second] = network.with_gradient(0, 0);

  CHECK(value == 5);
  CHECK(by_first == 0);
  CHECK(by_second == 0);
}

TEST_CASE("a dense network is not made from layers that do not chain from two inputs to one output")
{
  const auto refused = [](const std::vector<DenseLayer>& layers, const std::string& words) {
    CHECK_THROWS_AS(DenseNetwork(layers), BadValue);
    CHECK_THROWS_WITH(DenseNetwork(layers), Catch::Contains(words));
  };
  refused({}, "without a layer");
  refused(random_network::layers({3, 5, 1}, Activation::relu, Activation::linear), "3 inputs; expected 2");
  refused(random_network::layers({2, 5, 2}, Activation::relu, Activation::linear), "2 outputs; expected one");
  refused(random_network::layers({2, 513, 1}, Activation::relu, Activation::linear), "513 outputs; expected 1 to 512");

  auto layers = valid();
  layers[1] = random_network::layers({4, 3}, Activation::relu, Activation::linear).front();
  refused(layers, "4 inputs; expected 5");
  layers = valid();
  layers[0].n_outputs = 0;
  refused(layers, "0 outputs");
  layers = valid();
  layers[1].kernel.pop_back();
  refused(layers, "14 weights in its kernel; expected 15");
  layers = valid();
  layers[1].bias.push_back(0);
  refused(layers, "4 biases; expected 3");
}

TEST_CASE("a dense network is not made from weights that are not finite, and says in which layer they are")
{
  for (const double bad : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    for (const bool in_kernel : {true, false}) {
      auto layers = valid();
      (in_kernel ? layers[1].kernel : layers[1].bias)[2] = bad;

      try {
        const DenseNetwork network(layers);
        FAIL("made");
      } catch (const BadValue& error) {
        CHECK(error.row == 1);
        CHECK(error.found == "a weight or bias that is not finite");
      }
    }
  }
}

}  // namespace test_dense_network
