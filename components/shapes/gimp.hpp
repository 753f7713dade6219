#pragma once

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <span>

#include "components/lanes.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/shapes/stencil.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

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
    const Vector<D> place = block.in_cells(x);
    Stencil<D, support> stencil;
    stencil.first = 0;
    for (std::size_t k = 0; k < D; ++k) {
      const double node = along(place[static_cast<int>(k)], 1 / block.cell_size, stencil.weight[k], stencil.slope[k]);
      assert(node >= 0 && node + 2 < block.n_nodes[k]);
      stencil.first += static_cast<std::ptrdiff_t>(node) * block.strides[k];
    }
    return stencil;
  }

  /// The stencils of particles, no more than the batch can hold.
  void fill(StencilBatch<D, support>& batch, const GridBlock<D>& block, const ParticlePlaces<D>& places) const
  {
    const std::span<const Vector<D>> x = places.position;
    const double per_cell = 1 / block.cell_size;
    for (std::size_t p = 0; p < x.size(); p += n_lanes) {
      Lanes first = 0.0;
      Stencil<D, support, Lanes> stencil;
      for (std::size_t k = 0; k < D; ++k) {
        const int axis = static_cast<int>(k);
        const Lanes coordinate = each_lane([&](std::size_t l) { return x[std::min(p + l, x.size() - 1)][axis]; });
        const Lanes place = (coordinate - block.origin[axis]) * per_cell;
        const Lanes node = along(place, per_cell, stencil.weight[k], stencil.slope[k]);
        assert(!any(node < 0.0) && !any(node + 2.0 >= block.n_nodes[k]));
        first += node * static_cast<double>(block.strides[k]);
      }
      batch.set(p, first, stencil);
    }
  }

 private:
  struct OfHalfSize {
  };
  Gimp(double half_size, OfHalfSize) : half_size_(half_size) {}

  /// Weights and slopes along an axis for a particle at `place`, in cells; returns its first node.
  template <class Number>
  Number along(const Number& place, double per_cell, std::array<Number, support>& w,
               std::array<Number, support>& s) const
  {
    const double l = half_size_;
    const Number node = floor(place - l);
    // t in [l, 1 + l) from the first node. Up to 1 - l the particle lies within one cell and the functions are
    // linear; beyond, it straddles the second node, by e in [-l, l).
    const Number t = place - node;
    const Number e = greater_of<Number>(t - 1.0, -l);
    const Number within = greater_of<Number>(1 - l - t, 0.0);
    w[0] = (l - e) * (l - e) / (4 * l) + within;
    w[2] = (l + e) * (l + e) / (4 * l);
    w[1] = 1.0 - w[0] - w[2];
    s[0] = -(l - e) / (2 * l) * per_cell;
    s[2] = (l + e) / (2 * l) * per_cell;
    s[1] = -s[0] - s[2];
    return node;
  }

  double half_size_;
};

}  // namespace tamp::components
