#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <type_traits>

#include "components/lanes.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The weights <S_ip> of a particle at the nodes it reaches, and their gradients <grad S_ip> [1/m], as factors along
/// each axis: node (i, j, k) has the weight w[0][i] w[1][j] w[2][k] and stands at `first` + i s_x + j s_y + k s_z.
/// Where Number is Lanes they are those of as many particles, and `first` is 0: each counts nodes from its own first.
template <int D, int Support, class Number = double>
struct Stencil {
  std::ptrdiff_t first;
  std::array<std::array<Number, Support>, D> weight;
  std::array<std::array<Number, Support>, D> slope;
};

/// The stencils of up to `capacity` particles, made for as many at once as the processor has lanes.
template <int D, int Support>
class StencilBatch
{
 public:
  static constexpr std::size_t capacity = 32;
  static_assert(capacity % n_lanes == 0);

  /// Sets the stencils of n_lanes particles from `p` on; `first` has the places of their first nodes as whole numbers.
  void set(std::size_t p, const Lanes& first, const Stencil<D, Support, Lanes>& stencil)
  {
    for (std::size_t l = 0; l < n_lanes; ++l) first_[p + l] = static_cast<std::ptrdiff_t>(double{first[l]});
    for (std::size_t k = 0; k < D; ++k) {
      for (std::size_t i = 0; i < Support; ++i) {
        stencil.weight[k][i].copy_to(&weight_[k][i][p], std::experimental::element_aligned);
        stencil.slope[k][i].copy_to(&slope_[k][i][p], std::experimental::element_aligned);
      }
    }
  }

  /// Place of the first node of a particle.
  std::ptrdiff_t first(std::size_t p) const { return first_[p]; }
  /// The stencil of one particle.
  Stencil<D, Support> operator[](std::size_t p) const
  {
    return made<double>(first_[p], [p](const auto& values) { return values[p]; });
  }
  /// The stencils of n_lanes particles from `p` on.
  Stencil<D, Support, Lanes> lanes(std::size_t p) const
  {
    return made<Lanes>(0, [p](const auto& values) { return Lanes(&values[p], std::experimental::element_aligned); });
  }

 private:
  /// Weights or slopes by axis, node along it, and particle.
  using Factors = std::array<std::array<std::array<double, capacity>, Support>, D>;

  template <class Number, class Take>
  Stencil<D, Support, Number> made(std::ptrdiff_t first, Take&& take) const
  {
    Stencil<D, Support, Number> stencil;
    stencil.first = first;
    for (std::size_t k = 0; k < D; ++k) {
      for (std::size_t i = 0; i < Support; ++i) {
        stencil.weight[k][i] = take(weight_[k][i]);
        stencil.slope[k][i] = take(slope_[k][i]);
      }
    }
    return stencil;
  }

  std::array<std::ptrdiff_t, capacity> first_;
  Factors weight_, slope_;
};

/// Calls `visit(first, size, stencils)` for one batch of particles after the other.
template <class Interpolator, int D = Interpolator::dimension, class Visit>
[[gnu::always_inline]] inline void for_each_stencil_batch(const Interpolator& interpolator, const GridBlock<D>& block,
                                                          const ParticlePlaces<D>& places, Visit&& visit)
{
  StencilBatch<D, Interpolator::support> stencils;
  for (std::size_t first = 0; first < places.size(); first += stencils.capacity) {
    const std::size_t size = std::min(stencils.capacity, places.size() - first);
    interpolator.fill(stencils, block, places.subspan(first, size));
    visit(first, size, stencils);
  }
}

/// Calls `visit(p, stencil)` for one particle after the other.
template <class Interpolator, int D = Interpolator::dimension, class Visit>
[[gnu::always_inline]] inline void for_each_stencil(const Interpolator& interpolator, const GridBlock<D>& block,
                                                    const ParticlePlaces<D>& places, Visit&& visit)
{
  for_each_stencil_batch(interpolator, block, places, [&](std::size_t first, std::size_t size, const auto& stencils) {
    for (std::size_t p = 0; p < size; ++p) {
      const auto stencil = stencils[p];
      visit(first + p, stencil);
    }
  });
}

/// x_i - x_p of a particle's nodes along each axis [m].
template <int D, int Support>
using Arms = std::array<std::array<double, Support>, D>;

/// As weights reproduce linear functions, the particle is at the weighted mean of its nodes.
template <int D, int Support>
[[gnu::always_inline]] inline Arms<D, Support> arms_of(const Stencil<D, Support>& stencil, double cell_size)
{
  Arms<D, Support> arms;
  for (std::size_t k = 0; k < D; ++k) {
    double place = 0;  // in cells from the first node
    for (std::size_t i = 1; i < Support; ++i) place += static_cast<double>(i) * stencil.weight[k][i];
    for (std::size_t i = 0; i < Support; ++i) arms[k][i] = (static_cast<double>(i) - place) * cell_size;
  }
  return arms;
}

/// Second moments of a particle's weights about it, sum S_i (x_i - x)_k^2 [m^2]. Those of two axes are products of
/// first moments, which are zero.
template <int D, int Support>
[[gnu::always_inline]] inline Vector<D> second_moments_of(const Stencil<D, Support>& stencil,
                                                          const std::type_identity_t<Arms<D, Support>>& arms)
{
  Vector<D> sum = Vector<D>::Zero();
  for (std::size_t k = 0; k < D; ++k) {
    for (std::size_t i = 0; i < Support; ++i) {
      sum[static_cast<int>(k)] += stencil.weight[k][i] * arms[k][i] * arms[k][i];
    }
  }
  return sum;
}

/// A row of a stencil's nodes along x: the first one's place in the block, the row's place along the other axes of the
/// stencil, and what these give to all of its weights and of their gradients. Node i has the weight w[0][i] `across`;
/// its gradient has s[0][i] `across` along x and w[0][i] `slope_across` along the others.
template <int D, class Number = double>
struct StencilRow {
  std::ptrdiff_t first;
  std::array<std::size_t, D - 1> place;
  Number across;
  Vector<D - 1, Number> slope_across;
};

/// Calls `visit(row)` for every row of a stencil, y faster than z. Inlined, as it and what it calls are the innermost
/// loops of a step: left to itself, gcc calls them where many kernels stand in one unit.
template <int D, int Support, class Number, class Visit>
[[gnu::always_inline]] inline void for_each_row(const GridBlock<D>& block, const Stencil<D, Support, Number>& s,
                                                Visit&& visit)
{
  if constexpr (D == 2) {
    for (std::size_t j = 0; j < Support; ++j) {
      visit(StencilRow<2, Number>{s.first + static_cast<std::ptrdiff_t>(j) * block.strides[1],
                                  {j},
                                  s.weight[1][j],
                                  Vector<1, Number>(s.slope[1][j])});
    }
  } else {
    for (std::size_t k = 0; k < Support; ++k) {
      const std::ptrdiff_t plane = s.first + static_cast<std::ptrdiff_t>(k) * block.strides[2];
      for (std::size_t j = 0; j < Support; ++j) {
        visit(StencilRow<3, Number>{plane + static_cast<std::ptrdiff_t>(j) * block.strides[1],
                                    {j, k},
                                    s.weight[1][j] * s.weight[2][k],
                                    Vector<2, Number>(s.slope[1][j] * s.weight[2][k], s.weight[1][j] * s.slope[2][k])});
      }
    }
  }
}

/// Calls `visit(node, weight, cells)` for every node of a stencil, `node` being its place in the block and `cells` that
/// from the stencil's first node.
template <int D, int Support, class Visit>
[[gnu::always_inline]] inline void for_each_placed_weight(const GridBlock<D>& block, const Stencil<D, Support>& stencil,
                                                          Visit&& visit)
{
  for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
    Vector<D> cells;
    for (std::size_t k = 1; k < D; ++k) cells[static_cast<int>(k)] = static_cast<double>(row.place[k - 1]);
    for (std::size_t i = 0; i < Support; ++i) {
      cells[0] = static_cast<double>(i);
      visit(row.first + static_cast<std::ptrdiff_t>(i), stencil.weight[0][i] * row.across, cells);
    }
  });
}
/// Calls `visit(node, weight)` for every node of a stencil.
template <int D, int Support, class Visit>
[[gnu::always_inline]] inline void for_each_weight(const GridBlock<D>& block, const Stencil<D, Support>& stencil,
                                                   Visit&& visit)
{
  for_each_placed_weight(block, stencil,
                         [&](std::ptrdiff_t node, double weight, const Vector<D>&) { visit(node, weight); });
}

}  // namespace tamp::components
