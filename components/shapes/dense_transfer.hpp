#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "components/loads/pressure_load.hpp"
#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/transfer.hpp"
#include "components/tensors.hpp"

/// The kernels of transfer.hpp for interpolators with dense stencils.
namespace tamp::components
{

template <bool with_surface = true, Dense Interpolator, int D = Interpolator::dimension>
void particles_to_grid(const Interpolator& interpolator, const GridBlock<D>& block, const ParticleSources<D>& from,
                       NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, from.places, [&](std::size_t p, const auto& stencil) {
    const double surface = with_surface ? from.volume[p] : 0;
    const ParticleShare<D> share = share_of(from, p, surface);
    for_each_node(block, stencil, [&](std::ptrdiff_t node, double weight, const Vector<D>& gradient) {
      Quad second = 0;
      for (int k = 0; k < D; ++k) second += gradient[k] * share.with_derivative[static_cast<std::size_t>(k)];
      sums[node].add(0, weight * share.with_weight);
      sums[node].add(4, second);
      // See ParticleShare.
      if constexpr (D == 3 && with_surface) sums[node].add(8, surface * quad(gradient[1], gradient[2], 0, 0));
    });
  });
}

/// The place of a particle from those of its nodes, as weights reproduce linear functions.
template <int D, int Support>
Vector<D> mean_place(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil)
{
  Vector<D> place = Vector<D>::Zero();
  for_each_node(block, stencil,
                [&](std::ptrdiff_t node, double weight, const Vector<D>&) { place += weight * block.cells_to(node); });
  return place;
}

/// sum S_i (x_i - x) (x) (x_i - x) of a stencil about `place`, x in cells [m^2].
template <int D, int Support>
Matrix<D> second_moments_of(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil, const Vector<D>& place)
{
  Matrix<D> sum = Matrix<D>::Zero();
  for_each_weight(block, stencil, [&](std::ptrdiff_t i, double weight) {
    const Vector<D> away = block.cell_size * (block.cells_to(i) - place);
    sum += weight * away * away.transpose();
  });
  return sum;
}

/// m_p S_ip of each node of a particle times `gradient` (x_i - x_p), x in cells.
template <int D, int Support>
void add_gradient_momentum(const GridBlock<D>& block, const DenseStencil<D, Support>& stencil, const Vector<D>& place,
                           const Matrix<D>& gradient, NodeSums<D>* sums)
{
  for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) {
    sums[node].add_momentum(weight * (gradient * (block.cells_to(node) - place)));
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void add_gradient_momentum(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                           std::span<const double> mass, std::span<const Matrix<D>> velocity_gradient,
                           NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    const Matrix<D> gradient = mass[p] * block.cell_size * velocity_gradient[p];
    add_gradient_momentum<D>(block, stencil, mean_place(block, stencil), gradient, sums);
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void add_affine_momentum(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                         std::span<const double> mass, std::span<const Matrix<D>> velocity_moments, NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    const Vector<D> place = mean_place(block, stencil);
    const Matrix<D> of_weights = second_moments_of(block, stencil, place);
    const Matrix<D> gradient = mass[p] * block.cell_size * velocity_moments[p] * of_weights.inverse();
    add_gradient_momentum<D>(block, stencil, place, gradient, sums);
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void add_pressure(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                  std::span<const ByFace<D>> pressure, PressureSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) { sums[node].add(weight * pressure[p]); });
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void add_forces(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                std::span<const Vector<D>> force, NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    for_each_weight(block, stencil,
                    [&](std::ptrdiff_t node, double weight) { sums[node].add_force(weight * force[p]); });
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void grid_to_particles(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                       const NodeMotion<D>* nodes, std::span<ParticleMotion<D>> motion)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    ParticleMotion<D> sum{Vector<D>::Zero(), Vector<D>::Zero(), Matrix<D>::Zero()};
    for_each_node(block, stencil, [&](std::ptrdiff_t i, double weight, const Vector<D>& gradient) {
      const Vector<D> velocity = nodes[i].velocity();
      sum.velocity += weight * velocity;
      sum.velocity_change += weight * nodes[i].velocity_change();
      sum.velocity_gradient += velocity * gradient.transpose();
    });
    motion[p] = sum;
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void interpolate(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                 const NodeVector<D>* nodes, std::span<Vector<D>> values)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    values[p].setZero();
    for_each_weight(block, stencil, [&](std::ptrdiff_t i, double weight) { values[p] += weight * nodes[i].value(); });
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void add_vectors(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                 std::span<const Vector<D>> vectors, NodeVector<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    for_each_weight(block, stencil,
                    [&](std::ptrdiff_t i, double weight) { sums[i].set(sums[i].value() + weight * vectors[p]); });
  });
}

template <Dense Interpolator, int D = Interpolator::dimension>
void velocity_moments(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                      const NodeMotion<D>* nodes, std::span<Matrix<D>> moments)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    const Vector<D> place = mean_place(block, stencil);
    moments[p].setZero();
    for_each_weight(block, stencil, [&](std::ptrdiff_t i, double weight) {
      const Vector<D> away = block.cell_size * (block.cells_to(i) - place);
      moments[p] += weight * nodes[i].velocity() * away.transpose();
    });
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

template <Dense Interpolator, int D = Interpolator::dimension>
void own_stiffness(const Interpolator& interpolator, int n_per_axis, const GridBlock<D>& block,
                   const ParticlePlaces<D>& places, std::span<const double> mass, const double* inverse_mass,
                   std::span<double> stiffness)
{
  const double across_half_cell = std::max(1.0, 0.5 * n_per_axis);
  const double n_alike = D == 2 ? across_half_cell : across_half_cell * across_half_cell;
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    double sum = 0;
    for_each_node(block, stencil, [&](std::ptrdiff_t node, double, const Vector<D>& gradient) {
      sum += gradient.squaredNorm() * inverse_mass[node];
    });
    stiffness[p] = n_alike * block.cell_size * block.cell_size * mass[p] * sum;
  });
}

}  // namespace tamp::components
