#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <random>

#include "components/shapes/gimp.hpp"
#include "components/shapes/grid_block.hpp"

/// The interpolation of particles of constant size by its definition, without a formula of its own.
namespace tamp::test
{

/// A block of nodes, x fastest, away from the origin.
template <int D>
components::GridBlock<D> block_of_nodes(int n, double cell_size)
{
  components::GridBlock<D> block;
  block.cell_size = cell_size;
  std::ptrdiff_t stride = 1;
  for (std::size_t k = 0; k < D; ++k) {
    block.origin[static_cast<int>(k)] = 0.3 - 0.2 * static_cast<double>(k);
    block.n_nodes[k] = n + static_cast<int>(k);
    block.strides[k] = stride;
    stride *= block.n_nodes[k];
  }
  return block;
}

template <int D>
std::ptrdiff_t n_nodes_of(const components::GridBlock<D>& block)
{
  std::ptrdiff_t n = 1;
  for (const int along : block.n_nodes) n *= along;
  return n;
}

/// Position [m] of the node at a place in the block.
template <int D>
Vector<D> node_position(const components::GridBlock<D>& block, std::ptrdiff_t place)
{
  Vector<D> x = block.origin;
  for (std::size_t k = D; k-- > 0;) {
    const std::ptrdiff_t index = place / block.strides[k];
    x[static_cast<int>(k)] += block.cell_size * static_cast<double>(index);
    place -= index * block.strides[k];
  }
  return x;
}

/// Somewhere in the block that is at least one cell from its faces [m].
template <int D>
Vector<D> random_place(const components::GridBlock<D>& block, std::mt19937& random)
{
  Vector<D> x;
  for (std::size_t k = 0; k < D; ++k) {
    std::uniform_real_distribution<double> cells(1, block.n_nodes[k] - 2);
    x[static_cast<int>(k)] = block.origin[static_cast<int>(k)] + block.cell_size * cells(random);
  }
  return x;
}

/// The hat of a node at 0: 1 there, linear to 0 at the nodes beside it. `x` in cells.
inline double hat(double x)
{
  return std::max(0.0, 1 - std::abs(x));
}

/// Mean of the hat over [x - l, x + l], cells: mid-point sums between the hat's kinks, where they are exact.
inline double mean_of_hat(double x, double l)
{
  double sum = 0;
  for (const auto& [from, to] : {std::array{-1.0, 0.0}, std::array{0.0, 1.0}}) {
    const double a = std::max(from, x - l), b = std::min(to, x + l);
    if (a < b) sum += (b - a) * hat(0.5 * (a + b));
  }
  return sum / (2 * l);
}

/// Mean of the hat's slope over the same: its rise from end to end.
inline double mean_slope_of_hat(double x, double l)
{
  return (hat(x + l) - hat(x - l)) / (2 * l);
}

/// Weight of a particle at `x` [m] with half the edge `l` [cells] at a node, and its gradient [1/m].
template <int D>
struct PlainShape {
  double weight = 1;
  Vector<D> gradient = Vector<D>::Ones();

  PlainShape(const Vector<D>& x, const Vector<D>& node, double l, double cell_size)
  {
    for (int k = 0; k < D; ++k) {
      const double away = (x[k] - node[k]) / cell_size;
      weight *= mean_of_hat(away, l);
      for (int other = 0; other < D; ++other) {
        gradient[other] *= other == k ? mean_slope_of_hat(away, l) / cell_size : mean_of_hat(away, l);
      }
    }
  }
};

}  // namespace tamp::test
