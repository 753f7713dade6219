#pragma once

#include <algorithm>
#include <cstddef>
#include <span>

#include "components/loads/pressure_load.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// What particles bring to the grid; all spans of one length.
template <int D>
struct ParticleSources {
  std::span<const Vector<D>> position;
  std::span<const Vector<D>> velocity;
  std::span<const double> mass;
  std::span<const double> volume;
  std::span<const SymmetricTensor<D>> stress;
  /// Pressure of artificial viscosity [Pa], compression positive.
  std::span<const double> viscous_pressure;
};

/// Adds each particle's mass, momentum, internal force and surface gradient to the nodes it reaches
/// (PAR-10021867-092020-6, eqs 9, 36, 41). `sums` is the first node of `block`.
template <class Interpolator, int D = Interpolator::dimension>
void particles_to_grid(const Interpolator& interpolator, const GridBlock<D>& block, const ParticleSources<D>& from,
                       NodeSums<D>* sums)
{
  using Values = typename NodeSums<D>::Wide;
  for (std::size_t p = 0; p < from.position.size(); ++p) {
    const double m = from.mass[p];
    const double volume = from.volume[p];
    NodeSums<D> share;
    share.values[0] = m;
    share.set_vector(1, m * from.velocity[p]);
    const Values with_weight = share.wide();
    // Column k of -V (sigma - q I) goes with derivative k of the weight, as does the surface gradient's component k.
    const Matrix<D> force =
        -volume * (plane_part<D>(from.stress[p]) - from.viscous_pressure[p] * Matrix<D>::Identity());
    std::array<Values, D> with_slope;
    for (int k = 0; k < D; ++k) {
      NodeSums<D> column;
      column.set_vector(1 + D, force.col(k));
      column.values[1 + 2 * D + k] = volume;
      with_slope[static_cast<std::size_t>(k)] = column.wide();
    }
    const auto stencil = interpolator.at(block, from.position[p]);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      // What the nodes of the row have in common: what goes with their weights along x, and with the slopes of those.
      Values by_weight = row.across * with_weight;
      for (int k = 1; k < D; ++k) by_weight += row.slope_across[k - 1] * with_slope[static_cast<std::size_t>(k)];
      const Values by_slope = row.across * with_slope[0];
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add(stencil.weight[0][i] * by_weight +
                                                             stencil.slope[0][i] * by_slope);
      }
    });
  }
}

/// Adds to the momenta of nodes what the particles' velocity gradients tell of the velocities there,
/// m_p S_ip grad v_p (x_i - x_p), row of grad v: component of velocity (Wallstedt & Guilkey, CMES 19, 2007). A rigid
/// motion then comes to the grid as it is, where without it nodes at a surface get the velocity of the matter that they
/// reach, which lies to one side of them. The sums over the nodes are zero: momentum stays what it is.
template <class Interpolator, int D = Interpolator::dimension>
void add_gradient_momentum(const Interpolator& interpolator, const GridBlock<D>& block,
                           std::span<const Vector<D>> position, std::span<const double> mass,
                           std::span<const Matrix<D>> velocity_gradient, NodeSums<D>* sums)
{
  for (std::size_t p = 0; p < position.size(); ++p) {
    const Matrix<D> gradient = mass[p] * velocity_gradient[p];
    const auto stencil = with_moments(interpolator.at(block, position[p]), block.cell_size);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      Vector<D> by_weight = Vector<D>::Zero();
      for (int k = 1; k < D; ++k) by_weight += row.slope_across[k - 1] * gradient.col(k);
      const Vector<D> by_moment = row.across * gradient.col(0);
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add_momentum(stencil.weight[0][i] * by_weight +
                                                                      stencil.slope[0][i] * by_moment);
      }
    });
  }
}

/// Adds to the nodes what particles bring of a pressure load, m_p P_p S_ip.
template <class Interpolator, int D = Interpolator::dimension>
void add_pressure(const Interpolator& interpolator, const GridBlock<D>& block, std::span<const Vector<D>> position,
                  std::span<const ByFace<D>> pressure, PressureSums<D>* sums)
{
  for (std::size_t p = 0; p < position.size(); ++p) {
    const auto stencil = interpolator.at(block, position[p]);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add(stencil.weight[0][i] * row.across * pressure[p]);
      }
    });
  }
}

/// Adds to the forces on nodes the particles' shares of forces on them, S_ip f_p [N].
template <class Interpolator, int D = Interpolator::dimension>
void add_forces(const Interpolator& interpolator, const GridBlock<D>& block, std::span<const Vector<D>> position,
                std::span<const Vector<D>> force, NodeSums<D>* sums)
{
  for (std::size_t p = 0; p < position.size(); ++p) {
    const auto stencil = interpolator.at(block, position[p]);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      const Vector<D> by_weight = row.across * force[p];
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add_force(stencil.weight[0][i] * by_weight);
      }
    });
  }
}

/// What the grid gives back to one particle.
template <int D>
struct ParticleMotion {
  /// At the middle of the step [m/s].
  Vector<D> velocity;
  Vector<D> velocity_change;
  /// sum v_i (x) grad S_ip [1/s]; row: component of velocity.
  Matrix<D> velocity_gradient;
};

/// Interpolates the motion of the nodes to a particle (PAR-10021867-092020-6, eqs 43, 55).
template <class Interpolator, int D = Interpolator::dimension>
ParticleMotion<D> grid_to_particle(const Interpolator& interpolator, const GridBlock<D>& block, const Vector<D>& x,
                                   const NodeMotion<D>* nodes)
{
  using Values = typename NodeMotion<D>::Wide;
  Values moved = 0;
  std::array<Values, D> slopes;
  slopes.fill(0);
  const auto stencil = interpolator.at(block, x);
  for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
    Values by_weight = 0, by_slope = 0;
    for (std::size_t i = 0; i < Interpolator::support; ++i) {
      const Values values = nodes[row.first + static_cast<std::ptrdiff_t>(i)].wide();
      by_weight += stencil.weight[0][i] * values;
      by_slope += stencil.slope[0][i] * values;
    }
    moved += row.across * by_weight;
    slopes[0] += row.across * by_slope;
    for (int k = 1; k < D; ++k) slopes[static_cast<std::size_t>(k)] += row.slope_across[k - 1] * by_weight;
  });
  const auto vector = [](const Values& values, int first) {
    Vector<D> part;
    for (int k = 0; k < D; ++k) part[k] = values[static_cast<std::size_t>(first + k)];
    return part;
  };
  ParticleMotion<D> motion{vector(moved, 0), vector(moved, D), {}};
  for (int k = 0; k < D; ++k) motion.velocity_gradient.col(k) = vector(slopes[static_cast<std::size_t>(k)], 0);
  return motion;
}

/// h^2 m_p sum |grad S_ip|^2 / m_i, a pure number: how stiff a particle makes its nodes by itself, and so how fast they
/// can shake, in units of its modulus over density and h^2. Particles smaller than half a cell count with as many of
/// their like as lie side by side across half a cell, `n_per_axis` across one, as one layer of them moves as one.
/// Inside of a body it is below 1, at an edge about 5, and up to 9 an axis where a particle has its nodes to itself.
/// `inverse_mass` of nodes is in 1/kg, 0 at those that do not count.
template <class Interpolator, int D = Interpolator::dimension>
double own_stiffness(const Interpolator& interpolator, int n_per_axis, const GridBlock<D>& block, const Vector<D>& x,
                     double mass, const double* inverse_mass)
{
  double sum = 0;
  const auto stencil = interpolator.at(block, x);
  for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
    const double across = row.across * row.across, slope_across = row.slope_across.squaredNorm();
    for (std::size_t i = 0; i < Interpolator::support; ++i) {
      const double weight = stencil.weight[0][i], slope = stencil.slope[0][i];
      sum += (slope * slope * across + weight * weight * slope_across) *
             inverse_mass[row.first + static_cast<std::ptrdiff_t>(i)];
    }
  });
  const double across_half_cell = std::max(1.0, 0.5 * n_per_axis);
  const double n_alike = D == 2 ? across_half_cell : across_half_cell * across_half_cell;
  return n_alike * block.cell_size * block.cell_size * mass * sum;
}

}  // namespace tamp::components
