#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>

#include "components/lanes.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/shapes/stencil.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// An interpolator whose weights are products of weights along the axes. `Shape`, which derives from this, gives those:
///
///     Number along(const Number& place, const Number& cell, const Number& stretch, double per_cell, weights, slopes)
///     const
///
/// for a particle at `place` in `cell`, both in cells from the first node of the block; it returns that of the first
/// node reached. Number is double, or Lanes for as many particles. `stretch` is how much longer than at first the
/// particle is along the axis, and 1 where `Shape::deforms` is false.
template <class Shape, int D, int Support>
class ProductShape
{
 public:
  static constexpr int dimension = D;
  /// Nodes along an axis.
  static constexpr int support = Support;
  static constexpr bool is_spline = false;

  /// The reach of a particle anywhere in a cell, in cells; see interpolator.hpp.
  double reach() const { return 0.5 * Support; }

  /// The stencil of a particle at `x` that is not deformed.
  Stencil<D, Support> at(const GridBlock<D>& block, const Vector<D>& x) const
  {
    const Vector<D> place = block.in_cells(x);
    Stencil<D, Support> stencil;
    stencil.first = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double coordinate = place[static_cast<int>(k)];
      const double node = shape().template along<double>(coordinate, owned_cell<double>(coordinate, block.n_nodes[k]),
                                                         1.0, 1 / block.cell_size, stencil.weight[k], stencil.slope[k]);
      assert(node >= 0 && node + (Support - 1) < block.n_nodes[k]);
      stencil.first += static_cast<std::ptrdiff_t>(node) * block.strides[k];
    }
    return stencil;
  }

  /// The stencils of particles, no more than the batch can hold.
  void fill(StencilBatch<D, Support>& batch, const GridBlock<D>& block, const ParticlePlaces<D>& places) const
  {
    const double per_cell = 1 / block.cell_size;
    for (std::size_t p = 0; p < places.size(); p += n_lanes) {
      Lanes first = 0.0;
      Stencil<D, Support, Lanes> stencil;
      for (std::size_t k = 0; k < D; ++k) {
        const int axis = static_cast<int>(k);
        const Lanes coordinate =
            each_lane([&](std::size_t l) { return places.position[std::min(p + l, places.size() - 1)][axis]; });
        const Lanes place = (coordinate - block.origin[axis]) * per_cell;
        const Lanes node =
            shape().template along<Lanes>(place, owned_cell<Lanes>(place, block.n_nodes[k]), stretches(places, p, axis),
                                          per_cell, stencil.weight[k], stencil.slope[k]);
        assert(!any(node < 0.0) && !any(node + (Support - 1.0) >= block.n_nodes[k]));
        first += node * static_cast<double>(block.strides[k]);
      }
      batch.set(p, first, stencil);
    }
  }

 private:
  const Shape& shape() const { return static_cast<const Shape&>(*this); }

  /// sqrt((F F^T)_kk): a box as long as that along each axis has the second moments of the deformed particle.
  static Lanes stretches(const ParticlePlaces<D>& places, std::size_t p, int axis)
  {
    if constexpr (Shape::deforms) {
      return sqrt(each_lane([&](std::size_t l) {
        return places.deformation_gradient[std::min(p + l, places.size() - 1)].row(axis).squaredNorm();
      }));
    } else {
      return 1.0;
    }
  }
};

}  // namespace tamp::components
