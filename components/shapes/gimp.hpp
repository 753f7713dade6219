#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "components/shapes/grid_block.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The weights <S_ip> of a particle at the nodes it reaches, and their gradients <grad S_ip> [1/m], as factors along
/// each axis: node (i, j, k) has the weight w[0][i] w[1][j] w[2][k] and stands at `first` + i s_x + j s_y + k s_z.
template <int D, int Support>
struct Stencil {
  std::ptrdiff_t first;
  std::array<std::array<double, Support>, D> weight;
  std::array<std::array<double, Support>, D> slope;
};

/// A stencil with the weights' first moments about the particle, w[k][i] (x_i - x)_k [m], in place of their slopes. As
/// weights reproduce linear functions, the particle is at the weighted mean of its nodes.
template <int D, int Support>
Stencil<D, Support> with_moments(Stencil<D, Support> stencil, double cell_size)
{
  for (std::size_t k = 0; k < D; ++k) {
    const auto& w = stencil.weight[k];
    double place = 0;  // in cells from the first node
    for (std::size_t i = 1; i < Support; ++i) place += static_cast<double>(i) * w[i];
    for (std::size_t i = 0; i < Support; ++i) {
      stencil.slope[k][i] = w[i] * (static_cast<double>(i) - place) * cell_size;
    }
  }
  return stencil;
}

/// Generalised interpolation of particles of constant size: linear functions averaged over the particle's box
/// (Bardenhagen & Kober 2004; PAR-10021867-092020-6, eq. 22 and 44). 3 nodes an axis: 9 in the plane, 27 in space.
template <int D>
class Gimp
{
 public:
  static constexpr int dimension = D;
  static constexpr int support = 3;

  /// `n_per_axis` particles along each axis of a cell, each as large as its share; at least 1.
  explicit Gimp(int n_per_axis) : Gimp(0.5 / n_per_axis, {}) {}
  /// Averaged over the size of a cell, however small the particles, linear functions are the quadratic B-spline
  /// (Steffen, Kirby & Berzins, Int. J. Numer. Meth. Eng. 76, 2008).
  static Gimp quadratic_spline() { return Gimp(0.5, {}); }

  /// Half the edge of the box averaged over, in cells.
  double half_size() const { return half_size_; }

  Stencil<D, support> at(const GridBlock<D>& block, const Vector<D>& x) const
  {
    const double l = half_size_;
    const double per_cell = 1 / block.cell_size;
    const Vector<D> place = block.in_cells(x);
    Stencil<D, support> stencil;
    stencil.first = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double node = std::floor(place[static_cast<int>(k)] - l);
      assert(node >= 0 && node + 2 < block.n_nodes[k]);
      stencil.first += static_cast<std::ptrdiff_t>(node) * block.strides[k];
      // t in [l, 1 + l) from the first node. Up to 1 - l the particle lies within one cell and the functions are
      // linear; beyond, it straddles the second node, by e in [-l, l).
      const double t = place[static_cast<int>(k)] - node;
      const double e = std::max(t - 1, -l);
      const double within = std::max(1 - l - t, 0.0);
      auto& w = stencil.weight[k];
      auto& s = stencil.slope[k];
      w[0] = (l - e) * (l - e) / (4 * l) + within;
      w[2] = (l + e) * (l + e) / (4 * l);
      w[1] = 1 - w[0] - w[2];
      s[0] = -(l - e) / (2 * l) * per_cell;
      s[2] = (l + e) / (2 * l) * per_cell;
      s[1] = -s[0] - s[2];
    }
    return stencil;
  }

 private:
  struct OfHalfSize {
  };
  Gimp(double half_size, OfHalfSize) : half_size_(half_size) {}

  double half_size_;
};

/// A row of a stencil's nodes along x: the first one's place in the block, and what the other axes give to all of its
/// weights and of their gradients. Node i has the weight w[0][i] `across`; its gradient has s[0][i] `across` along x
/// and w[0][i] `slope_across` along the others.
template <int D>
struct StencilRow {
  std::ptrdiff_t first;
  double across;
  Vector<D - 1> slope_across;
};

/// Calls `visit(row)` for every row of a stencil, y faster than z. Inlined, as it and what it calls are the innermost
/// loops of a step: left to itself, gcc calls them where many kernels stand in one unit.
template <int D, int Support, class Visit>
[[gnu::always_inline]] inline void for_each_row(const GridBlock<D>& block, const Stencil<D, Support>& s, Visit&& visit)
{
  if constexpr (D == 2) {
    for (std::size_t j = 0; j < Support; ++j) {
      visit(StencilRow<2>{s.first + static_cast<std::ptrdiff_t>(j) * block.strides[1], s.weight[1][j],
                          Vector<1>(s.slope[1][j])});
    }
  } else {
    for (std::size_t k = 0; k < Support; ++k) {
      const std::ptrdiff_t plane = s.first + static_cast<std::ptrdiff_t>(k) * block.strides[2];
      for (std::size_t j = 0; j < Support; ++j) {
        visit(StencilRow<3>{plane + static_cast<std::ptrdiff_t>(j) * block.strides[1], s.weight[1][j] * s.weight[2][k],
                            Vector<2>(s.slope[1][j] * s.weight[2][k], s.weight[1][j] * s.slope[2][k])});
      }
    }
  }
}

}  // namespace tamp::components
