#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstddef>
#include <string_view>

#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Convected particle domain interpolation (Sadeghirad, Brannon & Burghardt, Int. J. Numer. Meth. Eng. 86, 2011): a
/// particle is the parallelogram, or parallelepiped, that F makes of its box, over which linear functions are taken for
/// linear between the corners. With half edges r_k and corners c at x + sum_k xi_ck r_k, xi = +-1, weights are the
/// means of N_i(x_c) and gradients the means of R^-T xi_c N_i(x_c), R having the columns r_k. 4 nodes an axis: where a
/// domain reaches further than a cell from its centre along an axis it is scaled down to that along the axis, as in
/// Homel, Brannon & Guilkey (Int. J. Numer. Meth. Eng. 107, 2016).
template <int D>
class Cpdi
{
 public:
  static constexpr std::string_view word = "cpdi";
  static constexpr std::string_view meaning = "their means over parallelograms or parallelepipeds that deform";
  static constexpr int dimension = D;
  static constexpr int support = 4;
  static constexpr bool deforms = true;
  static constexpr bool is_spline = false;

  /// `n_per_axis` particles along each axis of a cell, each as large as its share at first; at least 1.
  explicit Cpdi(int n_per_axis) : half_size_(0.5 / n_per_axis) {}

  double reach() const { return 2; }
  /// See components::greatest_own_stiffness: of a particle that is not deformed.
  double greatest_stiffness_along_axis() const { return 1 / half_size_ + 1 / (1 - half_size_); }

  DenseStencil<D, support> at(const GridBlock<D>& block, const Vector<D>& x, const Matrix<D>& f) const
  {
    const Vector<D> place = block.in_cells(x);
    const Corners corners = first_cell(block, place);
    // Half edges in cells.
    Matrix<D> edges = half_size_ * f;
    for (int k = 0; k < D; ++k) {
      const double extent = edges.row(k).template lpNorm<1>();
      if (extent > 1) edges.row(k) /= extent;
    }
    const Matrix<D> to_gradient = edges.inverse().transpose() / (n_corners * block.cell_size);
    DenseStencil<D, support> stencil(corners.place);
    for (unsigned c = 0; c < n_corners; ++c) {
      Vector<D> xi;
      for (int k = 0; k < D; ++k) xi[k] = (c >> k) % 2 == 0 ? -1 : 1;
      add_corner(stencil, place + edges * xi - corners.first, to_gradient * xi);
    }
    return stencil;
  }

 private:
  static constexpr unsigned n_corners = 1U << D;

  /// The first node of the stencil: in cells, and its place in the block.
  struct Corners {
    Vector<D> first;
    std::ptrdiff_t place;
  };

  static Corners first_cell(const GridBlock<D>& block, const Vector<D>& place)
  {
    Corners corners{{}, 0};
    for (int k = 0; k < D; ++k) {
      const auto axis = static_cast<std::size_t>(k);
      corners.first[k] = owned_cell<double>(place[k], block.n_nodes[axis]) - 1;
      assert(corners.first[k] >= 0 && corners.first[k] + (support - 1) < block.n_nodes[axis]);
      corners.place += static_cast<std::ptrdiff_t>(corners.first[k]) * block.strides[axis];
    }
    return corners;
  }

  /// The linear functions at a corner, `x` in cells from the first node; each goes into the gradient with `direction`.
  static void add_corner(DenseStencil<D, support>& stencil, const Vector<D>& x, const Vector<D>& direction)
  {
    std::array<std::array<double, 2>, D> hats;
    std::size_t node = 0, stride = 1;
    for (std::size_t k = 0; k < D; ++k) {
      const double along = x[static_cast<int>(k)];
      // A corner on the last node belongs to the cell before it.
      const double cell = std::clamp(std::floor(along), 0.0, support - 2.0);
      hats[k] = {1 - (along - cell), along - cell};
      node += static_cast<std::size_t>(cell) * stride;
      stride *= support;
    }
    for (unsigned n = 0; n < n_corners; ++n) {
      double weight = 1;
      std::size_t at = node, step = 1;
      for (std::size_t k = 0; k < D; ++k) {
        const std::size_t side = (n >> k) % 2;
        weight *= hats[k][side];
        at += side * step;
        step *= support;
      }
      stencil.weight[at] += weight / n_corners;
      stencil.gradient[at] += weight * direction;
    }
  }

  /// Half of a particle's size at the start [cells].
  double half_size_;
};

}  // namespace tamp::components
