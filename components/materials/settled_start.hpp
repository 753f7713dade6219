#pragma once

#include <fmt/core.h>

#include <concepts>

#include "components/errors.hpp"
#include "components/materials/invariants.hpp"
#include "components/materials/material_batch.hpp"

namespace tamp::components
{

/// The stress that a particle of settled ground bears.
struct SettledStress {
  SymmetricTensor<3> stress;  ///< Pa, tension positive; without shear along the axes
  double greatest;            ///< Pa: the greatest stress that it has borne along an axis, compression positive
};

/// Models whose bodies may start settled. `settled_state` is that of a particle; it throws BadValue where the stress is
/// more than the material can bear. Where the moduli change with pressure, `bulk_modulus(state, pressure)` is there
/// too.
template <class Model>
concept Settling = requires(const Model& model, const SettledStress& settled)
{
  {
    model.poisson_ratio()
    } -> std::same_as<double>;
  {
    model.settled_state(settled)
    } -> std::same_as<typename Model::State>;
};

/// Throws BadValue for a mean tension above what is borne [Pa].
inline void check_tension(double pressure, double tension)
{
  if (pressure >= -tension) return;
  throw BadValue(fmt::format("a mean tension of {:.4g} Pa", -pressure),
                 fmt::format("at most what it bears, {:.4g} Pa", tension));
}

/// Throws BadValue where the shear is more than `limit`, the sqrt(J2) of the yield surface at this pressure.
inline void check_is_borne(const Invariants& stress, double limit)
{
  if (stress.sqrt_j2() <= limit) return;
  throw BadValue(
      fmt::format("q = {:.4g} Pa at p = {:.4g} Pa", stress.q(), stress.pressure),
      fmt::format("at most the strength there, q = {:.4g} Pa; \"k0\", such as 0.5, gives another stress across",
                  std::sqrt(3.0) * limit));
}

/// Throws BadValue where stresses along the axes differ by more than Mohr and Coulomb's strength, see MohrCoulomb;
/// `cohesion` is 2 c cos(phi) [Pa].
inline void check_is_borne(const SettledStress& settled, double sin_friction, double cohesion)
{
  const double least = -settled.stress.head<3>().maxCoeff(), greatest = -settled.stress.head<3>().minCoeff();
  const double most = (least * (1 + sin_friction) + cohesion) / (1 - sin_friction);
  if (greatest <= most * (1 + 1e-12)) return;
  throw BadValue(
      fmt::format("{:.4g} Pa beside {:.4g} Pa across it", greatest, least),
      fmt::format("at most the strength there, {:.4g} Pa; \"k0\", such as 0.5, gives another stress across", most));
}

}  // namespace tamp::components
