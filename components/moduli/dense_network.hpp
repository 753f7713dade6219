#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "components/moduli/network_fit.hpp"

namespace tamp::components
{

/// A feed-forward network of dense layers, with two inputs and one output, made for one evaluation at a time. Its
/// answer is that of plain sums to about 1e-14 of the sums' terms; derivatives follow by the chain rule, and that of
/// relu at zero is 0. No allocation in an evaluation.
class DenseNetwork
{
 public:
  static constexpr std::size_t most_neurons = 512;  ///< in a layer

  /// Throws BadValue for no layer, shapes that do not follow on each other from two inputs to one output, a layer that
  /// is too wide, and numbers that are not finite; the row is the layer's.
  explicit DenseNetwork(std::span<const DenseLayer> layers);

  double value(double first, double second) const;

  struct Gradient {
    double value;
    double by_first, by_second;
  };
  Gradient with_gradient(double first, double second) const;

 private:
  /// All but the last layer: where its biases stand, and after them its kernel [input][output].
  struct HiddenLayer {
    Activation activation;
    std::size_t n_outputs;
    std::size_t first_row;
  };
  /// Part of a row: eight weights, zeros after the row's end.
  struct alignas(64) Weights {
    std::array<double, 8> of;
  };
  void append_row(std::span<const double> row);
  template <std::size_t n_streams>
  std::array<double, n_streams> evaluate(double first, double second) const;

  std::vector<HiddenLayer> hidden_;
  std::vector<Weights> weights_;
  Activation output_activation_;
  double output_bias_;
  std::size_t output_row_;
};

}  // namespace tamp::components
