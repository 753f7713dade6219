#pragma once

#include <algorithm>
#include <limits>
#include <type_traits>

#include "components/lanes.hpp"
#include "components/loads/artificial_viscosity.hpp"
#include "components/materials/wave_speed.hpp"
#include "components/portable_math.hpp"
#include "components/tensors.hpp"

/// Bounds on the time step [s] from one particle or one contact, before any safety factor; the step is the least of
/// them over all. Cell size in m, speeds in m/s.
namespace tamp::components
{

/// The rule below by which a particle bounds the step.
enum class StepRule { published, viscous };

/// The rule of the published runs: no signal and no particle crosses a cell, axis by axis.
template <int D, class Number = double>
Number published_time_step(double cell_size, const std::type_identity_t<Number>& wave_speed,
                           const Vector<D, Number>& velocity)
{
  Number fastest = 0.0;
  for (int k = 0; k < D; ++k) fastest = greater_of<Number>(fastest, abs(velocity[k]));
  return cell_size / (wave_speed + fastest);
}

/// A particle as the viscous rule sees it; as many as Number has lanes.
template <int D, class Number = double>
struct StiffParticle {
  Number density;                      ///< kg/m^3
  Number bulk_modulus, shear_modulus;  ///< Pa
  Vector<D, Number> velocity;          ///< m/s
  Number volume_rate;                  ///< tr D [1/s], expansion positive
  Number own_stiffness;                ///< see components::own_stiffness, a pure number
};

/// The part k0 in the bound below that does not come from a particle's own stiffness.
constexpr double shared_stiffness = 4.5;

/// The rule that counts sparsely filled nodes and artificial viscosity. A mode of the grid, x'' = -a x - b x' with a in
/// 1/s^2, b in 1/s and b x' of the step before (viscosity is lagged), forgets what the nodes do not hand back to the
/// particles; where they hand back nothing it stays bounded up to a dt^2 / 2 + b dt = 1. The largest a is
/// (k0 c^2 + s c_s^2) / h^2, s being the particle's own stiffness, and the largest b is (k0 + s) (C0 c_b + C1 h
/// max(0, -tr D)) / h, with the speeds c of dilatational waves, c_b = sqrt(K / density) and c_s of the modulus
/// K + (2/D - 2/3) G of equal strain along D axes: a particle that has its nodes to itself feels just s, one of many
/// what waves feel. That both may be added, and k0, are read from eigenvalues of blocks, balls and thinned out lattices
/// of particles at random offsets (tools/python/tamp stable-step). Both count `amplification` times where nodes move
/// that much further by what the particles push them with.
template <int D, class Number = double>
Number viscous_time_step(double cell_size, const StiffParticle<D, Number>& p, const ArtificialViscosity& viscosity,
                         double amplification = 1)
{
  const Number c = wave_speed(p.bulk_modulus, p.shear_modulus, p.density);
  const Number squeeze_modulus = p.bulk_modulus + (2.0 / D - 2.0 / 3.0) * p.shear_modulus;
  const Number a = amplification * (shared_stiffness * c * c + p.own_stiffness * squeeze_modulus / p.density);
  const Number closing_speed = cell_size * greater_of<Number>(0.0, -p.volume_rate);
  const Number b = amplification * (shared_stiffness + p.own_stiffness) *
                   (viscosity.linear * sqrt(p.bulk_modulus / p.density) + viscosity.quadratic * closing_speed);
  // h / dt, by the root of the quadratic without cancellation.
  const Number signal_speed = 0.5 * (b + sqrt(b * b + 2.0 * a));
  return cell_size / (signal_speed + sqrt(p.velocity.squaredNorm()));
}

/// Bound for matter that has separated and so has no waves, as a part of those above: it moves at most a tenth of a
/// cell in a step, so that a collision compacts it by no more than that at once.
constexpr double part_of_step_apart = 0.1;

/// Bodies that meet at `approach_speed` close no more than a tenth of a cell in a step, so that what they meet is
/// strained by no more than that at once; no bound if they do not approach.
inline double contact_time_step(double cell_size, double approach_speed)
{
  return approach_speed > 0 ? 0.1 * cell_size / approach_speed : std::numeric_limits<double>::infinity();
}

}  // namespace tamp::components
