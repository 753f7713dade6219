#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "components/lanes.hpp"
#include "components/moduli/dense_network.hpp"
#include "components/moduli/quad_tree.hpp"

namespace tamp::components
{

/// A dense network on a rectangle of its inputs, at the cost of a few of its neurons: one whose neurons are relu or
/// linear is linear between the lines on which neurons switch. The rectangle is cut into squares in which no more than
/// three do. All others of a square are linear or zero, and so the network's answer there is
///
///     plane + sum_k weight_k z_k,    z_k = relu(plane_k + sum_(i<k) weight_ki z_i),    k < 3,
///
/// with planes over the square, worked out beforehand. It is the network's own answer to round-off, no interpolation.
/// Where more than three switch in the smallest of squares, and for other activations, the network itself is asked.
class PiecewiseNetwork
{
 public:
  /// Throws BadValue as a DenseNetwork does. The rectangle has sides above 0.
  PiecewiseNetwork(std::span<const DenseLayer> layers, const std::array<double, 2>& low,
                   const std::array<double, 2>& high);

  /// Inputs in the rectangle. Each lane has the bits of a call by itself.
  double value(double first, double second) const;
  Lanes value(const Lanes& first, const Lanes& second) const;
  DenseNetwork::Gradient with_gradient(double first, double second) const;

  std::size_t n_squares() const { return pieces_.size(); }

 private:
  static constexpr std::size_t n_switching = 3;  // neurons in a square, at most

  /// Linear in the place within a square, from 0 to 1 in each input.
  template <class Number>
  struct PlaneOf {
    Number constant, by_first, by_second;

    Number at(const Number& first, const Number& second) const
    {
      return constant + by_first * first + by_second * second;
    }
  };
  using Plane = PlaneOf<double>;

  /// The network in a square. It consists of doubles alone, so that lanes can read them side by side.
  template <class Number>
  struct PieceOf {
    PlaneOf<Number> plane;  // not a number where the network itself is to be asked
    std::array<PlaneOf<Number>, n_switching> switching;
    std::array<Number, n_switching> weight;
    Number weight_10, weight_20, weight_21;  // weights of an earlier neuron's value in the later's sum
  };
  using Piece = PieceOf<double>;

  struct Square {
    QuadTree::Place first, second;  // place of the lower left corner
    int side_bits;
    std::size_t leaf;
  };
  void make_pieces(std::span<const DenseLayer> layers);
  std::optional<Piece> piece_of(std::span<const DenseLayer> layers, const Square& square) const;

  template <class Number>
  struct Located {
    PieceOf<Number> piece;
    Number first, second;      // in the square
    Number squares_per_uncut;  // in a row
  };
  template <class Number>
  Located<Number> locate(const Number& first, const Number& second) const;
  template <class Number>
  Number of_piece(const Number& first, const Number& second) const;

  DenseNetwork network_;
  std::array<double, 2> low_, squares_per_input_;
  QuadTree tree_;
  std::vector<Piece> pieces_;  // one for each leaf
};

}  // namespace tamp::components
