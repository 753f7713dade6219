#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "components/lanes.hpp"
#include "components/loads/pressure_load.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/stencil.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Particles' data for the grid; all spans of one length.
template <int D>
struct ParticleSources {
  ParticlePlaces<D> places;
  std::span<const Vector<D>> velocity;
  std::span<const double> mass;
  std::span<const double> volume;
  std::span<const SymmetricTensor<D>> stress;
  /// Pressure of artificial viscosity [Pa], compression positive.
  std::span<const double> viscous_pressure;
};

/// A particle's part of the sums at nodes: the first four of NodeSums times the weight, the second times its
/// derivatives. In space the second has room for the x component of the surface gradient only. `surface` is the
/// particle's volume where that gradient is wanted, and 0 elsewhere.
template <int D>
struct ParticleShare {
  Quad with_weight;
  std::array<Quad, D> with_derivative;
};

template <int D>
[[gnu::always_inline]] inline ParticleShare<D> share_of(const ParticleSources<D>& from, std::size_t p, double surface)
{
  const double m = from.mass[p];
  const Vector<D> momentum = m * from.velocity[p];
  // Column k of -V (sigma - q I) goes with derivative k of the weight, as does the surface gradient's component k.
  const Matrix<D> force =
      -from.volume[p] * (plane_part<D>(from.stress[p]) - from.viscous_pressure[p] * Matrix<D>::Identity());
  if constexpr (D == 2) {
    return {quad(m, momentum[0], momentum[1], 0),
            {quad(force(0, 0), force(1, 0), surface, 0), quad(force(0, 1), force(1, 1), 0, surface)}};
  } else {
    return {quad(m, momentum[0], momentum[1], momentum[2]),
            {quad(force(0, 0), force(1, 0), force(2, 0), surface), quad(force(0, 1), force(1, 1), force(2, 1), 0),
             quad(force(0, 2), force(1, 2), force(2, 2), 0)}};
  }
}

/// Each number in all places of a four.
template <std::size_t n>
std::array<Quad, n> in_fours(const std::array<double, n>& numbers)
{
  std::array<Quad, n> fours;
  std::copy(numbers.begin(), numbers.end(), fours.begin());
  return fours;
}

/// Adds each particle's mass, momentum, internal force and surface gradient to the nodes it reaches
/// (PAR-10021867-092020-6, eqs 9, 36, 41). `sums` is the first node of `block`. Without `with_surface` the gradient is
/// left out, which in space is a third of what is added up.
template <bool with_surface = true, class Interpolator, int D = Interpolator::dimension>
void particles_to_grid(const Interpolator& interpolator, const GridBlock<D>& block, const ParticleSources<D>& from,
                       NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, from.places, [&](std::size_t p, const auto& stencil) {
    const double surface = with_surface ? from.volume[p] : 0;
    const ParticleShare<D> share = share_of(from, p, surface);
    // Kept in registers, which what is stored at the nodes might otherwise seem to change.
    const auto weight = in_fours(stencil.weight[0]), slope = in_fours(stencil.slope[0]);
    for_each_row<D>(block, stencil, [&, sums](const StencilRow<D>& row) {
      // Common to the nodes of the row: what goes with their weights along x, and with the slopes of those.
      const Quad first = row.across * share.with_weight, by_slope = row.across * share.with_derivative[0];
      Quad second = row.slope_across[0] * share.with_derivative[1], third = 0;
      if constexpr (D == 3) {
        second += row.slope_across[1] * share.with_derivative[2];
        third = surface * quad(row.slope_across[0], row.slope_across[1], 0, 0);
      }
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        NodeSums<D>& node = sums[row.first + static_cast<std::ptrdiff_t>(i)];
        node.add(0, weight[i] * first);
        node.add(4, weight[i] * second + slope[i] * by_slope);
        if constexpr (D == 3 && with_surface) node.add(8, weight[i] * third);
      }
    });
  });
}

/// Adds to the momenta of the nodes of a particle m_p S_ip grad v_p (x_i - x_p): `gradient` is m_p grad v_p, and
/// `stencil` has moments in place of slopes.
template <int D, int Support>
[[gnu::always_inline]] inline void add_gradient_momentum(const GridBlock<D>& block, const Stencil<D, Support>& stencil,
                                                         const Matrix<D>& gradient, NodeSums<D>* sums)
{
  // Momenta follow the mass in the first four of a node, to which 0 is added.
  std::array<Quad, D> columns;
  for (int k = 0; k < D; ++k) {
    columns[static_cast<std::size_t>(k)] = quad(0, gradient(0, k), gradient(1, k), D == 3 ? gradient(D - 1, k) : 0);
  }
  const auto weight = in_fours(stencil.weight[0]), moment = in_fours(stencil.slope[0]);
  for_each_row<D>(block, stencil, [&, sums](const StencilRow<D>& row) {
    Quad by_weight = row.slope_across[0] * columns[1];
    if constexpr (D == 3) by_weight += row.slope_across[1] * columns[2];
    const Quad by_moment = row.across * columns[0];
    for (std::size_t i = 0; i < Support; ++i) {
      sums[row.first + static_cast<std::ptrdiff_t>(i)].add(0, weight[i] * by_weight + moment[i] * by_moment);
    }
  });
}

/// Adds to the momenta of nodes the velocities there by the particles' velocity gradients,
/// m_p S_ip grad v_p (x_i - x_p), row of grad v: component of velocity (Wallstedt & Guilkey, CMES 19, 2007). A rigid
/// motion then comes to the grid as it is, where without it nodes at a surface get the velocity of the matter that they
/// reach, which lies to one side of them. The sums over the nodes are zero: momentum stays what it is.
template <class Interpolator, int D = Interpolator::dimension>
void add_gradient_momentum(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                           std::span<const double> mass, std::span<const Matrix<D>> velocity_gradient,
                           NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    add_gradient_momentum<D>(block, with_moments(stencil, block.cell_size), mass[p] * velocity_gradient[p], sums);
  });
}

/// Adds to the momenta of nodes m_p S_ip C_p (x_i - x_p), C_p = B_p D_p^-1, where particles bring first moments B_p of
/// velocities and the second moments D_p of their weights have no products of two axes (APIC, see apic.hpp).
template <class Interpolator, int D = Interpolator::dimension>
void add_affine_momentum(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                         std::span<const double> mass, std::span<const Matrix<D>> velocity_moments, NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& of_particle) {
    const auto stencil = with_moments(of_particle, block.cell_size);
    const Vector<D> of_weights = second_moments_of(stencil, block.cell_size);
    const Matrix<D> gradient = mass[p] * velocity_moments[p] * of_weights.cwiseInverse().asDiagonal();
    add_gradient_momentum<D>(block, stencil, gradient, sums);
  });
}

/// Adds to the nodes what particles bring of a pressure load, m_p P_p S_ip.
template <class Interpolator, int D = Interpolator::dimension>
void add_pressure(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                  std::span<const ByFace<D>> pressure, PressureSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add(stencil.weight[0][i] * row.across * pressure[p]);
      }
    });
  });
}

/// Adds to the forces on nodes the particles' shares of forces on them, S_ip f_p [N].
template <class Interpolator, int D = Interpolator::dimension>
void add_forces(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                std::span<const Vector<D>> force, NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      const Vector<D> by_weight = row.across * force[p];
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add_force(stencil.weight[0][i] * by_weight);
      }
    });
  });
}

/// Velocities and gradients of the grid at one particle.
template <int D>
struct ParticleMotion {
  /// At the middle of the step [m/s].
  Vector<D> velocity;
  Vector<D> velocity_change;
  /// sum v_i (x) grad S_ip [1/s]; row: component of velocity.
  Matrix<D> velocity_gradient;
};

/// Interpolates the motion of the nodes to particles (PAR-10021867-092020-6, eqs 43, 55).
template <class Interpolator, int D = Interpolator::dimension>
void grid_to_particles(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                       const NodeMotion<D>* nodes, std::span<ParticleMotion<D>> motion)
{
  constexpr int at_change = NodeMotion<D>::at_change;
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    // The changes of velocity stand beside the velocities in the plane, and in the next four in space.
    Quad moved = 0, changed = 0;
    std::array<Quad, D> slopes;
    slopes.fill(0);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      Quad by_weight = 0, change_by_weight = 0, by_slope = 0;
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        const NodeMotion<D>& node = nodes[row.first + static_cast<std::ptrdiff_t>(i)];
        by_weight += stencil.weight[0][i] * node.four(0);
        by_slope += stencil.slope[0][i] * node.four(0);
        if constexpr (D == 3) change_by_weight += stencil.weight[0][i] * node.four(at_change);
      }
      moved += row.across * by_weight;
      changed += row.across * change_by_weight;
      slopes[0] += row.across * by_slope;
      for (int k = 1; k < D; ++k) slopes[static_cast<std::size_t>(k)] += row.slope_across[k - 1] * by_weight;
    });
    for (int i = 0; i < D; ++i) {
      const auto component = static_cast<std::size_t>(i);
      motion[p].velocity[i] = moved[component];
      motion[p].velocity_change[i] = D == 2 ? moved[component + 2] : changed[component];
      for (int k = 0; k < D; ++k) motion[p].velocity_gradient(i, k) = slopes[static_cast<std::size_t>(k)][component];
    }
  });
}

/// The vectors that nodes have where particles are, sum S_ip u_i.
template <class Interpolator, int D = Interpolator::dimension>
void interpolate(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                 const NodeVector<D>* nodes, std::span<Vector<D>> values)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    Quad sum = 0;
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      Quad by_weight = 0;
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        by_weight += stencil.weight[0][i] * nodes[row.first + static_cast<std::ptrdiff_t>(i)].four(0);
      }
      sum += row.across * by_weight;
    });
    for (int k = 0; k < D; ++k) values[p][k] = sum[static_cast<std::size_t>(k)];
  });
}

/// Adds to the nodes the particles' shares of vectors, S_ip a_p.
template <class Interpolator, int D = Interpolator::dimension>
void add_vectors(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                 std::span<const Vector<D>> vectors, NodeVector<D>* sums)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    const Vector<D>& a = vectors[p];
    const Quad vector = quad(a[0], a[1], D == 3 ? a[D - 1] : 0, 0);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      const Quad by_weight = row.across * vector;
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        sums[row.first + static_cast<std::ptrdiff_t>(i)].add(0, stencil.weight[0][i] * by_weight);
      }
    });
  });
}

/// First moments of the velocities of the nodes about particles, sum S_ip v_i (x) (x_i - x_p) [m^2/s]; row: component
/// of velocity.
template <class Interpolator, int D = Interpolator::dimension>
void velocity_moments(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                      const NodeMotion<D>* nodes, std::span<Matrix<D>> moments)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& of_particle) {
    const auto stencil = with_moments(of_particle, block.cell_size);
    std::array<Quad, D> columns;
    columns.fill(0);
    for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
      Quad by_weight = 0, by_moment = 0;
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        const Quad velocity = nodes[row.first + static_cast<std::ptrdiff_t>(i)].four(0);
        by_weight += stencil.weight[0][i] * velocity;
        by_moment += stencil.slope[0][i] * velocity;
      }
      columns[0] += row.across * by_moment;
      for (int k = 1; k < D; ++k) columns[static_cast<std::size_t>(k)] += row.slope_across[k - 1] * by_weight;
    });
    for (int i = 0; i < D; ++i) {
      for (int k = 0; k < D; ++k) {
        moments[p](i, k) = columns[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
      }
    }
  });
}

/// Second moments of the weights about particles, sum S_ip (x_i - x_p) (x) (x_i - x_p) [m^2].
template <class Interpolator, int D = Interpolator::dimension>
void second_moments(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                    std::span<Matrix<D>> moments)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    const auto with = with_moments(stencil, block.cell_size);
    moments[p] = second_moments_of(with, block.cell_size).asDiagonal();
  });
}

/// h^2 m_p sum |grad S_ip|^2 / m_i, a pure number: how stiff a particle makes its nodes by itself, and so how fast they
/// can shake, in units of its modulus over density and h^2. Particles smaller than half a cell count with as many of
/// their like as lie side by side across half a cell, `n_per_axis` across one, as one layer of them moves as one.
/// Inside of a body it is below 1, at an edge about 5, and up to 9 an axis where a particle has its nodes to itself.
/// `inverse_mass` of nodes is in 1/kg, 0 at those that do not count.
template <class Interpolator, int D = Interpolator::dimension>
void own_stiffness(const Interpolator& interpolator, int n_per_axis, const GridBlock<D>& block,
                   const ParticlePlaces<D>& places, std::span<const double> mass, const double* inverse_mass,
                   std::span<double> stiffness)
{
  const double across_half_cell = std::max(1.0, 0.5 * n_per_axis);
  const double n_alike = D == 2 ? across_half_cell : across_half_cell * across_half_cell;
  for_each_stencil_batch(interpolator, block, places, [&](std::size_t first, std::size_t size, const auto& stencils) {
    for (std::size_t p = 0; p < size; p += n_lanes) {
      Lanes sum = 0.0;
      const auto stencil = stencils.lanes(p);
      for_each_row<D>(block, stencil, [&](const StencilRow<D, Lanes>& row) {
        const Lanes across = row.across * row.across, slope_across = row.slope_across.squaredNorm();
        for (std::size_t i = 0; i < Interpolator::support; ++i) {
          const Lanes weight = stencil.weight[0][i], slope = stencil.slope[0][i];
          const std::ptrdiff_t node = row.first + static_cast<std::ptrdiff_t>(i);
          const Lanes per_mass = each_lane([&](std::size_t l) { return inverse_mass[stencils.first(p + l) + node]; });
          sum += (slope * slope * across + weight * weight * slope_across) * per_mass;
        }
      });
      for (std::size_t l = 0; l < std::min(n_lanes, size - p); ++l) {
        stiffness[first + p + l] = n_alike * block.cell_size * block.cell_size * mass[first + p + l] * sum[l];
      }
    }
  });
}

}  // namespace tamp::components
