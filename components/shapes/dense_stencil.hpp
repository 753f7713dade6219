#pragma once

#include <array>
#include <cstddef>

#include "components/shapes/grid_block.hpp"
#include "components/shapes/particle_places.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The weights <S_ip> of a particle, and their gradients <grad S_ip> [1/m], at each node of a block of `Support` nodes
/// an axis, x fastest, whose first stands at `first`: for interpolators that are no products of axes.
template <int D, int Support>
struct DenseStencil {
  static constexpr std::size_t n_nodes = D == 1   ? Support
                                         : D == 2 ? std::size_t{Support} * Support
                                                  : std::size_t{Support} * Support * Support;

  std::ptrdiff_t first;
  std::array<double, n_nodes> weight;
  std::array<Vector<D>, n_nodes> gradient;

  /// All of them zero.
  explicit DenseStencil(std::ptrdiff_t at) : first(at)
  {
    weight.fill(0);
    gradient.fill(Vector<D>::Zero());
  }
};

/// An interpolator whose weights at one particle are a DenseStencil.
template <class Interpolator>
concept Dense = requires(const Interpolator& interpolator, const GridBlock<Interpolator::dimension>& block,
                         const Vector<Interpolator::dimension>& x, const Matrix<Interpolator::dimension>& f)
{
  DenseStencil<Interpolator::dimension, Interpolator::support>(interpolator.at(block, x, f));
};

/// Calls `visit(node, weight, gradient)` for the nodes that a particle reaches, `node` being its place in the block.
template <int D, int Support, class Visit>
[[gnu::always_inline]] inline void for_each_node(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil,
                                                 Visit&& visit)
{
  constexpr std::size_t n = Support;
  for (std::size_t i = 0; i < stencil.n_nodes; ++i) {
    if (stencil.weight[i] == 0) continue;
    std::ptrdiff_t node = stencil.first + static_cast<std::ptrdiff_t>(i % n);
    if constexpr (D > 1) node += static_cast<std::ptrdiff_t>(i / n % n) * block.strides[1];
    if constexpr (D > 2) node += static_cast<std::ptrdiff_t>(i / (n * n)) * block.strides[2];
    visit(node, stencil.weight[i], stencil.gradient[i]);
  }
}

/// Calls `visit(node, weight, cells)` for them, `cells` being their place from the stencil's first node.
template <int D, int Support, class Visit>
[[gnu::always_inline]] inline void for_each_placed_weight(const GridBlock<D>& block,
                                                          const DenseStencil<D, Support>& stencil, Visit&& visit)
{
  for_each_node(block, stencil, [&](std::ptrdiff_t node, double weight, const Vector<D>&) {
    visit(node, weight, block.cells_to(node - stencil.first));
  });
}
/// Calls `visit(node, weight)` for them.
template <int D, int Support, class Visit>
[[gnu::always_inline]] inline void for_each_weight(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil,
                                                   Visit&& visit)
{
  for_each_node(block, stencil, [&](std::ptrdiff_t node, double weight, const Vector<D>&) { visit(node, weight); });
}

/// Calls `visit(p, stencil)` for one particle after the other.
template <Dense Interpolator, int D = Interpolator::dimension, class Visit>
void for_each_stencil(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                      Visit&& visit)
{
  for (std::size_t p = 0; p < places.size(); ++p) {
    visit(p, interpolator.at(block, places.position[p], places.deformation_gradient[p]));
  }
}

}  // namespace tamp::components
