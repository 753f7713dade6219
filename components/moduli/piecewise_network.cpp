#include "components/moduli/piecewise_network.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tamp::components
{

namespace
{

using Place = QuadTree::Place;

constexpr int n_uncut_squares = 64;  // along each side
constexpr int most_cuts = 12;
constexpr std::size_t most_pieces = std::size_t{1} << 16;
constexpr Place uncut_side = Place{1} << QuadTree::fraction_bits;
constexpr double per_uncut_side = 1.0 / static_cast<double>(uncut_side);

bool is_piecewise_linear(std::span<const DenseLayer> layers)
{
  return std::ranges::all_of(layers, [](const DenseLayer& layer) {
    return layer.activation == Activation::linear || layer.activation == Activation::relu;
  });
}

/// A neuron before its activation, over a square: constant, by each of the places, by each of the neurons that switch.
template <std::size_t n_terms>
using LinearForm = std::array<double, n_terms>;

/// The sums of a layer.
template <std::size_t n_terms>
std::vector<LinearForm<n_terms>> sums_of(const DenseLayer& layer, const std::vector<LinearForm<n_terms>>& inputs)
{
  std::vector<LinearForm<n_terms>> sums(layer.n_outputs, LinearForm<n_terms>{});
  for (std::size_t o = 0; o < layer.n_outputs; ++o) sums[o][0] = layer.bias[o];
  for (std::size_t i = 0; i < layer.n_inputs; ++i) {
    if (inputs[i] == LinearForm<n_terms>{}) continue;
    const double* const weights = &layer.kernel[i * layer.n_outputs];
    for (std::size_t o = 0; o < layer.n_outputs; ++o) {
      for (std::size_t t = 0; t < n_terms; ++t) sums[o][t] += weights[o] * inputs[i][t];
    }
  }
  return sums;
}

}  // namespace

PiecewiseNetwork::PiecewiseNetwork(std::span<const DenseLayer> layers, const std::array<double, 2>& low,
                                   const std::array<double, 2>& high)
    : network_(layers), low_(low), tree_(n_uncut_squares, n_uncut_squares)
{
  for (std::size_t i = 0; i < 2; ++i) squares_per_input_[i] = n_uncut_squares / (high[i] - low[i]);
  make_pieces(layers);
}

void PiecewiseNetwork::make_pieces(std::span<const DenseLayer> layers)
{
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  constexpr Piece ask_the_network{{unknown, 0, 0}, {}, {}, 0, 0, 0};
  pieces_.assign(n_uncut_squares * n_uncut_squares, ask_the_network);
  if (!is_piecewise_linear(layers)) return;

  std::vector<Square> squares;
  for (std::size_t leaf = 0; leaf < pieces_.size(); ++leaf) {
    const auto row = static_cast<Place>(leaf) / n_uncut_squares, column = static_cast<Place>(leaf) % n_uncut_squares;
    squares.push_back({column * uncut_side, row * uncut_side, QuadTree::fraction_bits, leaf});
  }
  for (std::size_t i = 0; i < squares.size(); ++i) {  // grows within the loop
    const Square whole = squares[i];
    if (const std::optional<Piece> piece = piece_of(layers, whole)) {
      pieces_[whole.leaf] = *piece;
      continue;
    }
    if (whole.side_bits == QuadTree::fraction_bits - most_cuts || pieces_.size() + 3 > most_pieces) continue;
    tree_.cut(whole.first, whole.second);
    const int side_bits = whole.side_bits - 1;
    const Place half = Place{1} << side_bits;
    const std::size_t n = pieces_.size();
    squares.push_back({whole.first, whole.second, side_bits, whole.leaf});
    squares.push_back({whole.first + half, whole.second, side_bits, n});
    squares.push_back({whole.first, whole.second + half, side_bits, n + 1});
    squares.push_back({whole.first + half, whole.second + half, side_bits, n + 2});
    pieces_.resize(n + 3, ask_the_network);
  }
}

/// None if too many neurons switch.
std::optional<PiecewiseNetwork::Piece> PiecewiseNetwork::piece_of(std::span<const DenseLayer> layers,
                                                                  const Square& square) const
{
  using Form = LinearForm<3 + n_switching>;
  const double side = static_cast<double>(Place{1} << square.side_bits) * per_uncut_side;
  const auto input = [&](std::size_t i, Place corner) {
    return low_[i] + static_cast<double>(corner) * per_uncut_side / squares_per_input_[i];
  };
  std::vector<Form> neurons{{input(0, square.first), side / squares_per_input_[0], 0},
                            {input(1, square.second), 0, side / squares_per_input_[1]}};

  std::array<Form, n_switching> switching{};
  std::array<double, n_switching> greatest{};
  std::size_t n = 0;
  for (const DenseLayer& layer : layers) {
    neurons = sums_of(layer, neurons);
    if (layer.activation == Activation::linear) continue;
    for (Form& neuron : neurons) {
      double least = neuron[0], most = neuron[0];
      const auto include = [&](double change) { (change < 0 ? least : most) += change; };
      include(neuron[1]);
      include(neuron[2]);
      for (std::size_t k = 0; k < n; ++k) include(neuron[3 + k] * greatest[k]);
      if (least >= 0) continue;
      if (most > 0) {
        if (n == n_switching) return std::nullopt;
        switching[n] = neuron;
        greatest[n] = most;
        neuron = {};
        neuron[3 + n] = 1;
        ++n;
      } else {
        neuron = {};
      }
    }
  }

  const auto plane = [](const Form& form) { return Plane{form[0], form[1], form[2]}; };
  const Form& output = neurons.front();
  return Piece{plane(output),
               {plane(switching[0]), plane(switching[1]), plane(switching[2])},
               {output[3], output[4], output[5]},
               switching[1][3],
               switching[2][3],
               switching[2][4]};
}

template <class Number>
inline PiecewiseNetwork::Located<Number> PiecewiseNetwork::locate(const Number& first, const Number& second) const
{
  const QuadTree::Found<Number> found =
      tree_.find_points<Number>((first - low_[0]) * squares_per_input_[0], (second - low_[1]) * squares_per_input_[1]);
  std::array<const double*, n_lanes_of<Number>> pieces;
  for (std::size_t l = 0; l < pieces.size(); ++l) pieces[l] = &pieces_[found.number[l]].plane.constant;
  const auto [p0, p1, p2, a0, a1, a2, b0, b1, b2, c0, c1, c2, a, b, c, ba, ca, cb] =
      side_by_side<sizeof(Piece) / sizeof(double)>(pieces);
  return {{{p0, p1, p2}, {{{a0, a1, a2}, {b0, b1, b2}, {c0, c1, c2}}}, {a, b, c}, ba, ca, cb},
          found.x,
          found.y,
          found.leaves_per_square};
}

template <class Number>
inline Number PiecewiseNetwork::of_piece(const Number& first, const Number& second) const
{
  const auto [piece, x, y, scale] = locate(first, second);
  const auto& [a, b, c] = piece.switching;
  const Number zero = 0.0;
  const Number z0 = greater_of(zero, a.at(x, y));
  const Number z1 = greater_of(zero, b.at(x, y) + piece.weight_10 * z0);
  const Number z2 = greater_of(zero, c.at(x, y) + piece.weight_20 * z0 + piece.weight_21 * z1);
  return piece.plane.at(x, y) + piece.weight[0] * z0 + piece.weight[1] * z1 + piece.weight[2] * z2;
}

double PiecewiseNetwork::value(double first, double second) const
{
  const double value = of_piece(first, second);
  return std::isnan(value) ? network_.value(first, second) : value;
}

Lanes PiecewiseNetwork::value(const Lanes& first, const Lanes& second) const
{
  const Lanes value = of_piece(first, second);
  if (!any(value != value)) return value;
  return each_lane([&](std::size_t l) {
    return std::isnan(double{value[l]}) ? network_.value(first[l], second[l]) : double{value[l]};
  });
}

DenseNetwork::Gradient PiecewiseNetwork::with_gradient(double first, double second) const
{
  const auto [piece, x, y, squares_per_uncut] = locate(first, second);
  if (std::isnan(piece.plane.constant)) return network_.with_gradient(first, second);

  // Sums over the neurons that are above zero are linear in the place, as these neurons are.
  const auto rectified = [&at_x = x, &at_y = y](const Plane& sum) {
    return sum.at(at_x, at_y) > 0 ? sum : Plane{0, 0, 0};
  };
  const auto plus = [](const Plane& p, double weight, const Plane& z) {
    return Plane{p.constant + weight * z.constant, p.by_first + weight * z.by_first,
                 p.by_second + weight * z.by_second};
  };
  const auto& [a, b, c] = piece.switching;
  const Plane z0 = rectified(a);
  const Plane z1 = rectified(plus(b, piece.weight_10, z0));
  const Plane z2 = rectified(plus(plus(c, piece.weight_20, z0), piece.weight_21, z1));
  const Plane answer = plus(plus(plus(piece.plane, piece.weight[0], z0), piece.weight[1], z1), piece.weight[2], z2);
  return {answer.at(x, y), answer.by_first * squares_per_uncut * squares_per_input_[0],
          answer.by_second * squares_per_uncut * squares_per_input_[1]};
}

}  // namespace tamp::components
