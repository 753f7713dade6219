#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <span>

#include "components/lanes.hpp"
#include "components/loads/artificial_viscosity.hpp"
#include "components/loads/time_step.hpp"
#include "components/materials/wave_speed.hpp"
#include "components/tensor_lanes.hpp"

namespace tamp::components
{

/// Settings of the method for the account of a batch.
struct AccountRules {
  double cell_size;  ///< m
  StepRule rule;
  std::optional<ArtificialViscosity> viscosity;
  /// The transfer's amplification of the motion of nodes.
  double amplification;
};

/// A batch of particles after its material has answered. Old values are of the start of the step, tension positive,
/// viscous pressures compression positive [Pa]; moduli and plastic work [J per m^3 of current volume] are the answer.
template <int D>
struct StressedBatch {
  std::span<const double> mass;
  std::span<const Vector<D>> velocity;
  std::span<const double> old_volume, volume;
  std::span<const SymmetricTensor<D>> strain_increment;
  std::span<const SymmetricTensor<D>> old_stress, stress;
  std::span<const double> old_viscous_pressure;
  std::span<const double> own_stiffness;
  std::span<const double> bulk_modulus, shear_modulus, plastic_work;
};

/// Shares of each particle of a batch of at most N in the energies of the step [J], and its bound on the next [s].
template <std::size_t N>
struct StressAccount {
  std::array<double, N> elastic, plastic, viscous;
  /// Work of the stress at the end of the step in its second half, which it takes from the motion.
  std::array<double, N> stress_work_at_end;
  std::array<double, N> stable_step;
  /// Speed of dilatational waves at the end of the step [m/s].
  std::array<double, N> wave_speed;
};

/// Artificial viscosity, energies, and the bound on the next step of `dt` [s], in lanes: vectorised code gives
/// each particle the same bits as scalar code. Where no modulus is, matter has separated.
template <int D, std::size_t N>
void account_for_stress(const AccountRules& rules, double dt, const StressedBatch<D>& batch,
                        std::span<double> viscous_pressure, StressAccount<N>& account)
{
  const std::size_t n = batch.stress.size();
  for (std::size_t k = 0; k < n; k += n_lanes) {
    const auto lanes = [n, k](const auto& values) { return lanes_at(std::span(values).first(n), k); };
    const Lanes volume = lanes(batch.volume), old_volume = lanes(batch.old_volume);
    const SymmetricTensor<D, Lanes> strain = lanes(batch.strain_increment);
    const Lanes bulk_modulus = lanes(batch.bulk_modulus);
    const Mask<Lanes> stiff = bulk_modulus > 0.0;
    // Where nothing is stiff nothing has to be damped.
    const Lanes volume_rate = select(stiff, trace(strain) / dt, Lanes(0.0));
    const StiffParticle<D, Lanes> p{.density = lanes(batch.mass) / volume,
                                    .bulk_modulus = bulk_modulus,
                                    .shear_modulus = lanes(batch.shear_modulus),
                                    .velocity = lanes(batch.velocity),
                                    .volume_rate = volume_rate,
                                    .own_stiffness = lanes(batch.own_stiffness)};
    const Lanes q =
        rules.viscosity ? rules.viscosity->pressure(p.density, p.bulk_modulus, p.volume_rate, rules.cell_size) : 0.0;

    // Work at the middle of the step. What the viscous pressure of the step before takes in its second half is that of
    // the step before: so both pressures have half of this step.
    const Lanes mid_volume = 0.5 * (old_volume + volume);
    const SymmetricTensor<D, Lanes> stress = lanes(batch.stress);
    const SymmetricTensor<D, Lanes> mid_stress = Lanes(0.5) * (lanes(batch.old_stress) + stress);
    const Lanes plastic = lanes(batch.plastic_work) * volume;
    set_lanes(account.elastic, k, double_dot(mid_stress, strain) * mid_volume - plastic);
    set_lanes(account.plastic, k, plastic);
    set_lanes(account.viscous, k, 0.5 * (lanes(batch.old_viscous_pressure) + q) * (old_volume - volume));
    set_lanes(account.stress_work_at_end, k,
              0.5 * (double_dot(stress, strain) * mid_volume + q * (old_volume - volume)));
    const Lanes c = wave_speed(p.bulk_modulus, p.shear_modulus, p.density);
    const Lanes stable_step =
        rules.rule == StepRule::published
            ? published_time_step<D>(rules.cell_size, c, p.velocity)
            : viscous_time_step<D>(rules.cell_size, p, rules.viscosity.value_or(ArtificialViscosity{0, 0}),
                                   rules.amplification);
    set_lanes(account.stable_step, k, select(stiff, stable_step, part_of_step_apart * stable_step));
    set_lanes(account.wave_speed, k, c);
    set_lanes(viscous_pressure, k, q);
  }
}

}  // namespace tamp::components
