#pragma once

#include "components/materials/tabular_cap.hpp"

namespace tamp::components
{

/// Sand that separates: grains that fly by themselves bear nothing and resist nothing until their volume is again
/// what it was when they parted. That they bear nothing below a density is from S. Dunatunga and K. Kamrin, Continuum
/// modelling and simulation of granular flows through their many phases, J. Fluid Mech. 779, 2015; here they must have
/// been torn from each other too, at the tension vertex. Volumes are det F, over that at the start.

/// Whether a step that ended at this pressure (compression positive) and J2 had its trial beyond the tension vertex,
/// which takes all shear.
inline bool is_torn(const TabularCap& sand, double pressure, double j2)
{
  constexpr double round_off = 1e-9;
  return j2 == 0 && pressure <= (1 - round_off) * sand.parameters().yield.vertex_pressure();
}

/// Whether what is torn is so light that it separates, which with gaps it does at any density.
inline bool is_light(const TabularCap& sand, double volume)
{
  return sand.keeps_gaps() || volume * sand.parameters().separation_density.value() > 1;
}

/// Energy that is lost as a particle at the tension vertex separates, beside the work on its plastic strain in that
/// step, of which it may take back a part [J per m3 of current volume]. That is what it has stored, p^2 / 2K, less what
/// its stress would still have done: the work of a step is that of the mean of the stresses at its ends (see
/// update_stress.cpp), and the one at this end is now zero. `expansion` is the step's.
inline double energy_of_parting(double pressure, double bulk_modulus, double expansion)
{
  return 0.5 * pressure * (pressure / bulk_modulus + expansion);
}

/// Volumetric compaction beyond the volume at which it parted, measured as strain increments are. A particle joins
/// without stress at the end of the step in which it gets there, and counts this as plastic: with its stiffness it may
/// stand less of a step than it just took without.
template <class Number>
Number compaction_beyond(const Number& separation_volume, const Number& volume)
{
  return 2.0 * (separation_volume - volume) / (separation_volume + volume);
}

}  // namespace tamp::components
