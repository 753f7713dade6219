#pragma once

#include <cstddef>
#include <span>

#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/transfer.hpp"
#include "components/tensors.hpp"

/// The kernels of transfer.hpp that go row by row, for interpolators with dense stencils, which go node by node.
namespace tamp::components
{

/// x_i - x_p of a node, where a particle is at `place` in cells from the first node [m].
template <int D>
Vector<D> arm_of(const GridBlock<D>& block, std::ptrdiff_t node, const Vector<D>& place)
{
  return block.cell_size * (block.cells_to(node) - place);
}

/// The place of a particle from those of its nodes, as weights reproduce linear functions.
template <int D, int Support>
Vector<D> mean_place(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil)
{
  Vector<D> place = Vector<D>::Zero();
  for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) { place += weight * block.cells_to(node); });
  return place;
}

/// sum S_i (x_i - x) (x) (x_i - x) of a stencil about `place`, x in cells [m^2].
template <int D, int Support>
Matrix<D> second_moments_of(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil, const Vector<D>& place)
{
  Matrix<D> sum = Matrix<D>::Zero();
  for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) {
    const Vector<D> arm = arm_of(block, node, place);
    sum += weight * arm * arm.transpose();
  });
  return sum;
}

template <bool with_surface = true, bool carries = false, Plane plane = Plane::slab, Dense Interpolator,
          int D = Interpolator::dimension>
void particles_to_grid(const Interpolator& interpolator, const GridBlock<D>& block, const ParticleSources<D>& from,
                       NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, from.places, [&](std::size_t p, const auto& stencil) {
    const double surface = with_surface ? from.volume[p] : 0;
    const ParticleShare<D> share = share_of(from, p, surface);
    Quad hoop = 0;
    if constexpr (plane == Plane::revolved) hoop = hoop_share(from, p, surface);
    Vector<D> place;
    std::array<Quad, D> columns;
    if constexpr (carries) {
      place = mean_place(block, stencil);
      columns = beside_mass<D>(
          momentum_gradient(from, p, [&] { return Matrix<D>(second_moments_of(block, stencil, place).inverse()); }));
    }
    for_each_node(block, stencil, [&](std::ptrdiff_t node, double weight, const Vector<D>& gradient) {
      Quad first = share.with_weight, second = 0;
      if constexpr (carries) {
        const Vector<D> arm = arm_of(block, node, place);
        for (int k = 0; k < D; ++k) first += arm[k] * columns[static_cast<std::size_t>(k)];
      }
      for (int k = 0; k < D; ++k) second += gradient[k] * share.with_derivative[static_cast<std::size_t>(k)];
      if constexpr (plane == Plane::revolved) second += weight * hoop;
      sums[node].add(0, weight * first);
      sums[node].add(4, second);
      // See ParticleShare.
      if constexpr (D == 3 && with_surface) sums[node].add(8, surface * quad(gradient[1], gradient[2], 0, 0));
    });
  });
}

template <Dense Interpolator, int D = Interpolator::dimension, Plane plane = Plane::slab>
void grid_to_particles(const Interpolator& interpolator, int n_per_axis, const GridBlock<D>& block,
                       const ParticlePlaces<D>& places, const NodeMotion<D>* nodes, const ParticleTargets<D>& to)
{
  const double unit = stiffness_unit<D>(n_per_axis, block.cell_size);
  const OwnStiffness& own = to.own_stiffness;
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    ParticleMotion<D> sum{Vector<D>::Zero(), Vector<D>::Zero(), Matrix<D>::Zero()};
    for_each_node(block, stencil, [&](std::ptrdiff_t node, double weight, const Vector<D>& gradient) {
      const Vector<D> velocity = nodes[node].velocity();
      sum.velocity += weight * velocity;
      sum.velocity_change += weight * nodes[node].velocity_change();
      sum.velocity_gradient += velocity * gradient.transpose();
    });
    to.motion[p] = sum;
    if (!to.velocity_moments.empty()) {
      const Vector<D> place = mean_place(block, stencil);
      Matrix<D> moments = Matrix<D>::Zero();
      for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) {
        moments += weight * nodes[node].velocity() * arm_of(block, node, place).transpose();
      });
      to.velocity_moments[p] = moments;
    }
    if (own.stiffness.empty()) return;
    const double per_radius = plane == Plane::revolved ? 1 / places.position[p][0] : 0;
    double per_mass = 0;
    for_each_node(block, stencil, [&](std::ptrdiff_t node, double weight, const Vector<D>& gradient) {
      double square = gradient.squaredNorm();
      if constexpr (plane == Plane::revolved) square += weight * weight * per_radius * per_radius;
      per_mass += square * own.inverse_mass[node];
    });
    own.stiffness[p] = unit * own.mass[p] * per_mass;
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void second_moments(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                    std::span<Matrix<D>> moments)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    moments[p] = second_moments_of(block, stencil, mean_place(block, stencil));
  });
}

}  // namespace tamp::components
