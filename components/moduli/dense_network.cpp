#include "components/moduli/dense_network.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <utility>

#include "components/errors.hpp"
#include "components/lanes.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

#if defined(__AVX512F__)
constexpr std::size_t register_bytes = 64, n_registers = 32;
#elif defined(__AVX__)
constexpr std::size_t register_bytes = 32, n_registers = 16;
#else
constexpr std::size_t register_bytes = 16, n_registers = 16;
#endif

/// Neurons that the processor takes at a time.
using Pack [[gnu::vector_size(register_bytes), gnu::may_alias]] = double;
using PackBits [[gnu::vector_size(register_bytes)]] = std::int64_t;

constexpr std::size_t pack_size = register_bytes / sizeof(double);

// These sizes decide in which order numbers are added, and so are the same for every processor.
constexpr std::size_t block_size = 64;
constexpr std::size_t none = block_size;  // the place of the first of no set bits
constexpr std::size_t most_blocks = DenseNetwork::most_neurons / block_size;
constexpr std::size_t row_multiple = 8;  // rows of weights are padded to multiples of it

constexpr std::size_t padded(std::size_t n)
{
  return (n + row_multiple - 1) / row_multiple * row_multiple;
}
constexpr std::size_t packs_for(std::size_t n_neurons)
{
  return padded(n_neurons) / pack_size;
}
/// Since an addition waits for the one before, inputs go by turns to two sums where outputs are few.
constexpr std::size_t turns_for(std::size_t n_outputs, std::size_t n_streams)
{
  return n_streams * padded(n_outputs) / row_multiple < 8 ? 2 : 1;
}

/// Bit i is set where the i-th neuron is positive.
inline std::uint64_t positive(const Pack& neurons)
{
  std::uint64_t bits = 0;
  // Compared whole: gcc 12 with -fsanitize=undefined takes any element of a vector it has by reference for the first.
  const auto signs = neurons > 0;
  for (std::size_t i = 0; i < pack_size; ++i) bits |= static_cast<std::uint64_t>(signs[i] & 1) << i;
  return bits;
}

/// e^x to 1e-15 of it for |x| < 700, and held beyond: x = k ln 2 + r, and a series for r.
inline void exponential(Pack& x)
{
  constexpr double limit = 700, ln2_high = 0x1.62e42fefap-1, ln2_low = 0x1.cf79abc9e3b39p-40;
  constexpr double rounding = 0x1.8p52;  // beside it no fraction is left
  x = x < -limit ? Pack{} - limit : x > limit ? Pack{} + limit : x;
  const Pack k = (x * std::numbers::log2e + rounding) - rounding;
  const Pack r = x - k * ln2_high - k * ln2_low;
  Pack series = Pack{} + 1;
  for (int term = 13; term > 0; --term) series = 1 + series * r * (1.0 / term);
  const PackBits power_of_two = (__builtin_convertvector(k, PackBits) + 1023) << 52;
  x = series * reinterpret_cast<const Pack&>(power_of_two);
}

/// Up to 64 of a layer's neurons: the values and, for a gradient, the derivatives by both inputs. `active` has a bit
/// for each that may be other than zero. In a relu layer that is less than half, and the rest is not multiplied by
/// anything.
template <std::size_t n_streams>
struct alignas(64) Block {
  double streams[n_streams][none + pack_size];  // [none] is zero
  std::uint64_t active;

  Pack& pack(std::size_t stream, std::size_t j) { return reinterpret_cast<Pack&>(streams[stream][j * pack_size]); }
  const Pack& pack(std::size_t stream, std::size_t j) const
  {
    return reinterpret_cast<const Pack&>(streams[stream][j * pack_size]);
  }
};

/// n packs of neurons before their activation.
template <std::size_t n, std::size_t n_streams>
struct Sums {
  Pack packs[n_streams * n];
};

/// sums += inputs kernel
template <std::size_t n_turns, std::size_t n, std::size_t n_streams>
inline void add_products(const Block<n_streams>& inputs, const Pack* kernel, std::size_t packs_per_row,
                         Sums<n, n_streams>& sums)
{
  Sums<n, n_streams> by_turns[n_turns] = {sums};
  std::uint64_t left = inputs.active;
  while (left != 0) {
    unrolled<n_turns>([&](auto turn) {
      const auto i = static_cast<std::size_t>(std::countr_zero(left));
      const Pack* const row = kernel + i % block_size * packs_per_row;
      unrolled<n_streams * n>([&](auto k) { by_turns[turn].packs[k] += inputs.streams[k / n][i] * row[k % n]; });
      left &= left - 1;
    });
  }
  sums = by_turns[0];
  if constexpr (n_turns == 2) unrolled<n_streams * n>([&](auto k) { sums.packs[k] += by_turns[1].packs[k]; });
}

/// Writes the rectified sums into the outputs, from the block's j-th pack on.
template <std::size_t n, std::size_t n_streams>
inline void rectify(const Sums<n, n_streams>& sums, Block<n_streams>& outputs, std::size_t j)
{
  unrolled<n_streams * n>([&](auto k) {
    outputs.pack(k / n, j + k % n) = sums.packs[k % n] > 0 ? sums.packs[k] : Pack{};
    if (k < n) outputs.active |= positive(sums.packs[k]) << ((j + k) * pack_size);
  });
}

/// Sigmoid or tanh of a block's j-th pack. tanh x = 2 sigmoid(2 x) - 1
template <std::size_t n_streams>
void bend(Activation activation, Block<n_streams>& block, std::size_t j)
{
  const double stretch = activation == Activation::tanh ? 2 : 1;
  Pack power = -stretch * block.pack(0, j);
  exponential(power);
  const Pack sigmoid = 1 / (1 + power);
  block.pack(0, j) = stretch * sigmoid - (stretch - 1);
  for (std::size_t s = 1; s < n_streams; ++s) block.pack(s, j) *= stretch * stretch * sigmoid * (1 - sigmoid);
}

/// A layer's weights, from one pack of outputs on.
struct LayerView {
  Activation activation;
  std::size_t n_inputs, n_outputs;
  std::size_t packs_per_row;
  const Pack* bias;
  const Pack* kernel;
};

/// n packs of a layer's outputs, the block's j-th and those that follow.
template <std::size_t n_turns, std::size_t n, std::size_t n_streams>
inline void make_packs(const LayerView& layer, const Block<n_streams>* inputs, Block<n_streams>& outputs, std::size_t j)
{
  Sums<n, n_streams> sums{};
  unrolled<n>([&](auto k) { sums.packs[k] = layer.bias[j + k]; });
  for (std::size_t i = 0; i < layer.n_inputs; i += block_size) {
    const Pack* const kernel = layer.kernel + i * layer.packs_per_row + j;
    add_products<n_turns>(inputs[i / block_size], kernel, layer.packs_per_row, sums);
  }

  if (layer.activation == Activation::relu) return rectify(sums, outputs, j);
  unrolled<n_streams * n>([&](auto k) { outputs.pack(k / n, j + k % n) = sums.packs[k]; });
  if (layer.activation == Activation::linear) return;
  for (std::size_t k = 0; k < n; ++k) bend(layer.activation, outputs, j + k);
}

/// Computes a layer for a block, as many packs at a time as there are registers for their sums.
template <std::size_t n_turns, std::size_t n_streams>
inline void make_block(const LayerView& layer, const Block<n_streams>* inputs, Block<n_streams>& outputs)
{
  constexpr std::size_t n_at_once = std::min<std::size_t>(8, n_registers * 3 / 4 / (n_streams * n_turns));
  for (auto& stream : outputs.streams) stream[none] = 0;
  outputs.active = layer.activation == Activation::relu ? 0 : ~std::uint64_t{0} >> (64 - layer.n_outputs);
  const std::size_t n_packs = packs_for(layer.n_outputs);
  for (std::size_t j = 0; j < n_packs; j += n_at_once) {
    unrolled<n_at_once>([&](auto less_one) {
      if (std::min(n_packs - j, n_at_once) == less_one + 1) {
        make_packs<n_turns, less_one + 1>(layer, inputs, outputs, j);
      }
    });
  }
}

template <std::size_t n_streams>
inline void make_layer(LayerView layer, const Block<n_streams>* inputs, Block<n_streams>* outputs)
{
  for (std::size_t left = layer.n_outputs; left > 0; left -= layer.n_outputs) {
    layer.n_outputs = std::min(left, block_size);
    if (turns_for(layer.n_outputs, n_streams) == 2) {
      make_block<2>(layer, inputs, *outputs);
    } else {
      make_block<1>(layer, inputs, *outputs);
    }
    layer.bias += packs_for(layer.n_outputs);
    layer.kernel += packs_for(layer.n_outputs);
    ++outputs;
  }
}

template <std::size_t n_streams>
inline void set_inputs(double first, double second, Block<n_streams>& block)
{
  for (auto& stream : block.streams) {
    std::fill_n(stream, padded(2), 0);
    stream[none] = 0;
  }
  block.streams[0][0] = first;
  block.streams[0][1] = second;
  for (std::size_t s = 1; s < n_streams; ++s) block.streams[s][s - 1] = 1;
  block.active = 3;
}

/// The sums of the neurons' products with a row of weights, of every eighth neuron first.
template <std::size_t n_streams>
inline std::array<double, n_streams> dot(const Block<n_streams>* neurons, std::size_t n, const Pack* row)
{
  constexpr std::size_t n_parts = row_multiple / pack_size, block_packs = block_size / pack_size;
  Pack products[n_streams][n_parts] = {};
  for (std::size_t j = 0; j < packs_for(n); j += n_parts) {
    unrolled<n_streams * n_parts>([&](auto k) {
      constexpr std::size_t s = k / n_parts, part = k % n_parts;
      products[s][part] += neurons[j / block_packs].pack(s, j % block_packs + part) * row[j + part];
    });
  }
  std::array<double, n_streams> sums{};
  for (std::size_t s = 0; s < n_streams; ++s) {
    for (std::size_t i = 0; i < row_multiple; ++i) sums[s] += products[s][i / pack_size][i % pack_size];
  }
  return sums;
}

struct Activated {
  double value, slope;
};
inline Activated activated(Activation activation, double x)
{
  switch (activation) {
    case Activation::relu:
      return x > 0 ? Activated{x, 1} : Activated{0, 0};
    case Activation::sigmoid: {
      const double y = 1 / (1 + portable::exp(-x));
      return {y, y * (1 - y)};
    }
    case Activation::tanh: {
      const double y = portable::tanh(x);
      return {y, 1 - y * y};
    }
    case Activation::linear:
      break;
  }
  return {x, 1};
}

void check(const DenseLayer& layer, std::size_t n_inputs, std::ptrdiff_t row)
{
  const auto demand = [&](std::size_t found, std::size_t expected, const std::string& what) {
    if (found != expected) {
      throw BadValue("a layer with " + std::to_string(found) + " " + what, std::to_string(expected), row);
    }
  };
  demand(layer.n_inputs, n_inputs, "inputs");
  if (layer.n_outputs == 0 || layer.n_outputs > DenseNetwork::most_neurons) {
    throw BadValue("a layer with " + std::to_string(layer.n_outputs) + " outputs",
                   "1 to " + std::to_string(DenseNetwork::most_neurons), row);
  }
  demand(layer.kernel.size(), layer.n_inputs * layer.n_outputs, "weights in its kernel");
  demand(layer.bias.size(), layer.n_outputs, "biases");
  const auto finite = [](double x) { return std::isfinite(x); };
  if (!std::ranges::all_of(layer.kernel, finite) || !std::ranges::all_of(layer.bias, finite)) {
    throw BadValue("a weight or bias that is not finite", "finite numbers", row);
  }
}

}  // namespace

DenseNetwork::DenseNetwork(std::span<const DenseLayer> layers)
{
  if (layers.empty()) throw BadValue("a network without a layer", "at least one");
  std::size_t n_inputs = 2;
  for (std::size_t l = 0; l < layers.size(); ++l) {
    check(layers[l], n_inputs, static_cast<std::ptrdiff_t>(l));
    n_inputs = layers[l].n_outputs;
  }
  if (n_inputs != 1) throw BadValue("a network with " + std::to_string(n_inputs) + " outputs", "one");

  for (const DenseLayer& layer : layers.first(layers.size() - 1)) {
    hidden_.push_back({layer.activation, layer.n_outputs, weights_.size()});
    append_row(layer.bias);
    for (std::size_t i = 0; i < layer.n_inputs; ++i) {
      append_row(std::span(layer.kernel).subspan(i * layer.n_outputs, layer.n_outputs));
    }
  }
  output_activation_ = layers.back().activation;
  output_bias_ = layers.back().bias.front();
  output_row_ = weights_.size();
  append_row(layers.back().kernel);
}

void DenseNetwork::append_row(std::span<const double> row)
{
  const std::size_t first = weights_.size();
  weights_.resize(first + padded(row.size()) / 8);
  for (std::size_t i = 0; i < row.size(); ++i) weights_[first + i / 8].of[i % 8] = row[i];
}

template <std::size_t n_streams>
std::array<double, n_streams> DenseNetwork::evaluate(double first, double second) const
{
  Block<n_streams> blocks[2][most_blocks];
  Block<n_streams>*inputs = blocks[0], *outputs = blocks[1];
  set_inputs(first, second, *inputs);
  std::size_t n_inputs = 2;
  for (const HiddenLayer& layer : hidden_) {
    const auto bias = reinterpret_cast<const Pack*>(&weights_[layer.first_row]);
    const std::size_t n_packs = packs_for(layer.n_outputs);
    make_layer({layer.activation, n_inputs, layer.n_outputs, n_packs, bias, bias + n_packs}, inputs, outputs);
    std::swap(inputs, outputs);
    n_inputs = layer.n_outputs;
  }

  std::array<double, n_streams> answer = dot(inputs, n_inputs, reinterpret_cast<const Pack*>(&weights_[output_row_]));
  const auto [value, slope] = activated(output_activation_, answer[0] + output_bias_);
  answer[0] = value;
  for (std::size_t s = 1; s < n_streams; ++s) answer[s] *= slope;
  return answer;
}

double DenseNetwork::value(double first, double second) const
{
  return evaluate<1>(first, second)[0];
}

DenseNetwork::Gradient DenseNetwork::with_gradient(double first, double second) const
{
  const auto [value, by_first, by_second] = evaluate<3>(first, second);
  return {value, by_first, by_second};
}

}  // namespace tamp::components
