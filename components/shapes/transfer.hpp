#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "components/lanes.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/shapes/plane.hpp"
#include "components/shapes/stencil.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The gradient that particles carry to the nodes beside their velocity: none; the gradient of velocity [1/s]; or its
/// first moment sum S_ip v_i (x) (x_i - x_p) [m^2/s], which becomes a gradient by the second moments of
/// the weights. Either comes from the grid, half a step behind the place, and is state.
enum class CarriedGradient { none, gradient, moment };

/// Particles' data for the grid; all spans of one length, but that nothing is carried where `carried_gradient` is none.
template <int D>
struct ParticleSources {
  ParticlePlaces<D> places;
  std::span<const Vector<D>> velocity;
  std::span<const double> mass;
  std::span<const double> volume;
  std::span<const SymmetricTensor<D>> stress;
  /// Pressure of artificial viscosity [Pa], compression positive.
  std::span<const double> viscous_pressure;
  CarriedGradient carried_gradient = CarriedGradient::none;
  /// Row: component of velocity.
  std::span<const Matrix<D>> carried = {};
};

/// A particle's part of the sums at nodes: the first four of NodeSums times the weight, the second times its
/// derivatives. In space the second has room for the x component of the surface gradient only. `surface` is the
/// particle's volume where that gradient is wanted, and 0 elsewhere.
template <int D>
struct ParticleShare {
  Quad with_weight;
  std::array<Quad, D> with_derivative;
};

/// The share of a particle's hoop that goes with its weight, to be added to the second four: the force of its hoop
/// stress on r, and V / r to the surface gradient, which so vanishes within a body as it does in a slab.
inline Quad hoop_share(const ParticleSources<2>& from, std::size_t p, double surface)
{
  const double per_radius = 1 / from.places.position[p][0];
  const double stress = from.stress[p][2] - from.viscous_pressure[p];
  return quad(-from.volume[p] * stress * per_radius, 0, surface * per_radius, 0);
}

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

/// The gradient of momentum that particle p brings [kg/s]: m_p grad v_p, or m_p B_p D_p^-1 from first moments B_p of
/// velocities and the second moments D_p of its weights (APIC, see apic.hpp): `inverse_moments()` is D_p^-1.
template <int D, class InverseMoments>
[[gnu::always_inline]] inline Matrix<D> momentum_gradient(const ParticleSources<D>& from, std::size_t p,
                                                          const InverseMoments& inverse_moments)
{
  if (from.carried_gradient == CarriedGradient::gradient) return from.mass[p] * from.carried[p];
  return from.mass[p] * from.carried[p] * inverse_moments();
}

/// The columns of a gradient of momentum as they are added to the first four of NodeSums, where momenta follow the
/// mass.
template <int D>
std::array<Quad, D> beside_mass(const Matrix<D>& gradient)
{
  std::array<Quad, D> columns;
  for (int k = 0; k < D; ++k) {
    columns[static_cast<std::size_t>(k)] = quad(0, gradient(0, k), gradient(1, k), D == 3 ? gradient(D - 1, k) : 0);
  }
  return columns;
}

/// Adds each particle's mass, momentum, internal force and surface gradient to the nodes it reaches
/// (PAR-10021867-092020-6, eqs 9, 36, 41). `sums` is the first node of `block`. Without `with_surface` the gradient is
/// left out, which in space is a third of what is added up.
///
/// Particles that carry gradients bring m_p S_ip (v_p + grad v_p (x_i - x_p)) (Wallstedt & Guilkey, CMES 19, 2007). A
/// rigid motion then comes to the grid as it is, where without it nodes at a surface get the velocity of the matter
/// that they reach, which lies to one side of them. The contributions of the gradients sum to zero over the nodes, so
/// that momentum is conserved.
template <bool with_surface = true, bool carries = false, Plane plane = Plane::slab, class Interpolator,
          int D = Interpolator::dimension>
void particles_to_grid(const Interpolator& interpolator, const GridBlock<D>& block, const ParticleSources<D>& from,
                       NodeSums<D>* sums)
{
  for_each_stencil(interpolator, block, from.places, [&](std::size_t p, const auto& stencil) {
    const double surface = with_surface ? from.volume[p] : 0;
    const ParticleShare<D> share = share_of(from, p, surface);
    Quad hoop = 0;
    if constexpr (plane == Plane::revolved) hoop = hoop_share(from, p, surface);
    Arms<D, Interpolator::support> arms;
    std::array<Quad, D> columns;
    if constexpr (carries) {
      arms = arms_of(stencil, block.cell_size);
      columns = beside_mass<D>(momentum_gradient(
          from, p, [&] { return Eigen::DiagonalMatrix<double, D>(second_moments_of(stencil, arms).cwiseInverse()); }));
    }
    // Kept in registers: otherwise stores to the nodes might seem to change them.
    const auto weight = in_fours(stencil.weight[0]), slope = in_fours(stencil.slope[0]);
    for_each_row<D>(block, stencil, [&, sums](const StencilRow<D>& row) {
      // Common to the nodes of the row: the factors of their weights along x, and of the slopes of these.
      Quad with_weight = share.with_weight;
      if constexpr (carries) {
        for (std::size_t k = 1; k < D; ++k) with_weight += arms[k][row.place[k - 1]] * columns[k];
      }
      const Quad first = row.across * with_weight, by_slope = row.across * share.with_derivative[0];
      Quad second = row.slope_across[0] * share.with_derivative[1], third = 0;
      if constexpr (plane == Plane::revolved) second += row.across * hoop;
      if constexpr (D == 3) {
        second += row.slope_across[1] * share.with_derivative[2];
        third = surface * quad(row.slope_across[0], row.slope_across[1], 0, 0);
      }
      for (std::size_t i = 0; i < Interpolator::support; ++i) {
        NodeSums<D>& node = sums[row.first + static_cast<std::ptrdiff_t>(i)];
        if constexpr (carries) {
          node.add(0, weight[i] * (first + arms[0][i] * (row.across * columns[0])));
        } else {
          node.add(0, weight[i] * first);
        }
        node.add(4, weight[i] * second + slope[i] * by_slope);
        if constexpr (D == 3 && with_surface) node.add(8, weight[i] * third);
      }
    });
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
    for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) { sums[node].add(0, weight * vector); });
  });
}

/// The vectors that nodes have where particles are, sum S_ip u_i.
template <class Interpolator, int D = Interpolator::dimension>
void interpolate(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                 const NodeVector<D>* nodes, std::span<Vector<D>> values)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    Quad sum = 0;
    for_each_weight(block, stencil, [&](std::ptrdiff_t node, double weight) { sum += weight * nodes[node].four(0); });
    for (int k = 0; k < D; ++k) values[p][k] = sum[static_cast<std::size_t>(k)];
  });
}

/// Velocities and gradients of the grid at one particle.
template <int D>
struct ParticleMotion {
  /// Velocity at the middle of the step [m/s].
  Vector<D> velocity;
  Vector<D> velocity_change;
  /// sum v_i (x) grad S_ip [1/s]; row: component of velocity.
  Matrix<D> velocity_gradient;
};

/// How stiff particles make their nodes by themselves, and so how fast they can shake: h^2 m_p sum |grad S_ip|^2 / m_i,
/// a pure number, in units of their moduli over density and h^2. Particles smaller than half a cell count with as many
/// of their like as lie side by side across half a cell, as one layer of them moves as one. Inside of a body it is
/// below 1, at an edge about 5, and up to 9 an axis where a particle has its nodes to itself. A ring has (S_ip / r_p)^2
/// beside |grad S_ip|^2.
struct OwnStiffness {
  std::span<const double> mass;
  /// Inverse masses of the nodes [1/kg], 0 at those that do not count.
  const double* inverse_mass = nullptr;
  std::span<double> stiffness;
};

/// The data that particles take from the grid: all spans of one length; all but the first are empty where nobody needs
/// them.
template <int D>
struct ParticleTargets {
  std::span<ParticleMotion<D>> motion;
  /// First moments of the velocities of the nodes about particles, sum S_ip v_i (x) (x_i - x_p) [m^2/s]; row: component
  /// of velocity.
  std::span<Matrix<D>> velocity_moments = {};
  OwnStiffness own_stiffness = {};
};

/// h^2 times how many particles, `n_per_axis` across a cell, count as one in own stiffness.
template <int D>
double stiffness_unit(int n_per_axis, double cell_size)
{
  const double across_half_cell = std::max(1.0, 0.5 * n_per_axis);
  return (D == 2 ? across_half_cell : across_half_cell * across_half_cell) * cell_size * cell_size;
}

/// The matrix that has the first D numbers of each four for a column.
template <int D>
Matrix<D> matrix_of(const std::array<Quad, D>& columns)
{
  Matrix<D> matrix;
  for (int i = 0; i < D; ++i) {
    for (int k = 0; k < D; ++k) matrix(i, k) = columns[static_cast<std::size_t>(k)][static_cast<std::size_t>(i)];
  }
  return matrix;
}

/// The motion of the nodes at particle p of targets, and its moments.
template <bool with_moments, int D, int Support>
[[gnu::always_inline]] inline void take_motion(const GridBlock<D>& block, const Stencil<D, Support>& stencil,
                                               const NodeMotion<D>* nodes, const ParticleTargets<D>& to, std::size_t p)
{
  constexpr int at_change = NodeMotion<D>::at_change;
  Arms<D, Support> arms;
  if constexpr (with_moments) arms = arms_of(stencil, block.cell_size);
  // The changes of velocity stand beside the velocities in the plane, and in the next four in space.
  Quad moved = 0, changed = 0;
  std::array<Quad, D> slopes, moments;
  slopes.fill(0);
  moments.fill(0);
  for_each_row<D>(block, stencil, [&](const StencilRow<D>& row) {
    Quad by_weight = 0, change_by_weight = 0, by_slope = 0, by_arm = 0;
    for (std::size_t i = 0; i < Support; ++i) {
      const NodeMotion<D>& node = nodes[row.first + static_cast<std::ptrdiff_t>(i)];
      by_weight += stencil.weight[0][i] * node.four(0);
      by_slope += stencil.slope[0][i] * node.four(0);
      if constexpr (D == 3) change_by_weight += stencil.weight[0][i] * node.four(at_change);
      if constexpr (with_moments) by_arm += stencil.weight[0][i] * arms[0][i] * node.four(0);
    }
    moved += row.across * by_weight;
    changed += row.across * change_by_weight;
    slopes[0] += row.across * by_slope;
    if constexpr (with_moments) moments[0] += row.across * by_arm;
    for (std::size_t k = 1; k < D; ++k) {
      slopes[k] += row.slope_across[static_cast<int>(k) - 1] * by_weight;
      if constexpr (with_moments) moments[k] += row.across * arms[k][row.place[k - 1]] * by_weight;
    }
  });
  ParticleMotion<D>& motion = to.motion[p];
  for (int i = 0; i < D; ++i) {
    const auto component = static_cast<std::size_t>(i);
    motion.velocity[i] = moved[component];
    motion.velocity_change[i] = D == 2 ? moved[component + 2] : changed[component];
  }
  motion.velocity_gradient = matrix_of<D>(slopes);
  if constexpr (with_moments) to.velocity_moments[p] = matrix_of<D>(moments);
}

/// The own stiffness of `size` particles of targets from `first` on, which are at `places`.
template <Plane plane, int D, int Support>
void find_stiffness(double unit, const GridBlock<D>& block, const StencilBatch<D, Support>& stencils, std::size_t size,
                    const OwnStiffness& own, std::size_t first, const ParticlePlaces<D>& places)
{
  for (std::size_t p = 0; p < size; p += n_lanes) {
    Lanes sum = 0.0, per_radius = 0.0;
    const auto stencil = stencils.lanes(p);
    if constexpr (plane == Plane::revolved) {
      const std::size_t last = size - 1;
      per_radius = 1.0 / each_lane([&](std::size_t l) { return places.position[first + std::min(p + l, last)][0]; });
    }
    for_each_row<D>(block, stencil, [&](const StencilRow<D, Lanes>& row) {
      const Lanes across = row.across * row.across;
      Lanes slope_across = row.slope_across.squaredNorm();
      if constexpr (plane == Plane::revolved) slope_across += across * per_radius * per_radius;
      for (std::size_t i = 0; i < Support; ++i) {
        const Lanes weight = stencil.weight[0][i], slope = stencil.slope[0][i];
        const std::ptrdiff_t node = row.first + static_cast<std::ptrdiff_t>(i);
        const Lanes per_mass = each_lane([&](std::size_t l) { return own.inverse_mass[stencils.first(p + l) + node]; });
        sum += (slope * slope * across + weight * weight * slope_across) * per_mass;
      }
    });
    for (std::size_t l = 0; l < std::min(n_lanes, size - p); ++l) {
      own.stiffness[first + p + l] = unit * own.mass[first + p + l] * sum[l];
    }
  }
}

/// Interpolates the motion of the nodes to particles (PAR-10021867-092020-6, eqs 43, 55), `n_per_axis` across a cell.
template <class Interpolator, int D = Interpolator::dimension, Plane plane = Plane::slab>
void grid_to_particles(const Interpolator& interpolator, int n_per_axis, const GridBlock<D>& block,
                       const ParticlePlaces<D>& places, const NodeMotion<D>* nodes, const ParticleTargets<D>& to)
{
  const double unit = stiffness_unit<D>(n_per_axis, block.cell_size);
  const bool has_moments = !to.velocity_moments.empty(), has_stiffness = !to.own_stiffness.stiffness.empty();
  for_each_stencil_batch(interpolator, block, places, [&](std::size_t first, std::size_t size, const auto& stencils) {
    for (std::size_t p = 0; p < size; ++p) {
      const auto stencil = stencils[p];
      if (has_moments) {
        take_motion<true>(block, stencil, nodes, to, first + p);
      } else {
        take_motion<false>(block, stencil, nodes, to, first + p);
      }
    }
    if (has_stiffness) find_stiffness<plane>(unit, block, stencils, size, to.own_stiffness, first, places);
  });
}

/// Second moments of the weights about particles, sum S_ip (x_i - x_p) (x) (x_i - x_p) [m^2].
template <class Interpolator, int D = Interpolator::dimension>
void second_moments(const Interpolator& interpolator, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                    std::span<Matrix<D>> moments)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    moments[p] = second_moments_of(stencil, arms_of(stencil, block.cell_size)).asDiagonal();
  });
}

}  // namespace tamp::components
