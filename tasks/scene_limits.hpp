#pragma once

#include <array>

#include "components/parameter.hpp"

namespace tamp::tasks
{

/// Beyond these a run has gone wrong or is not to be trusted: beyond the first it ends, beyond the second a step is
/// tried again, beyond the others the run ends with a warning. docs/reference/monitors.md has where they come
/// from.
struct SceneLimits {
  double energy_error = 0.2;
  double courant_number = 1;
  double redone_steps = 0.1;
  double missed_substeps = 0.05;
  double swollen_load = 0.3;
  double looser_than_tested = 0.2;
  double out_of_range = 0.2;
  double energy_drift = 0.02;
  double momentum_error = 0.01;
  double filtered_energy = 0.1;
  double damped_energy = 0.05;
  double null_space = 0.25;
  double uneven_pressure = 0.5;
  double torn_apart = 0.01;
  double early_contact = 0.1;
  double early_at_walls = 0.1;
  double interpenetration = 0.1;
  double lost_mass = 0.01;
  double forecast_missed = 2;
  int sampled_every = 50;

  bool samples_after(long n_steps) const { return n_steps % sampled_every == 0; }
  /// All but the first.
  static constexpr std::array<components::Parameter<SceneLimits>, 19> parameters();
};

constexpr std::array<components::Parameter<SceneLimits>, 19> SceneLimits::parameters()
{
  using components::above_zero, components::zero_or_above;
  using L = SceneLimits;
  constexpr components::Range part{.lower = 0, .upper = 1};
  return {
      {{"courant_number", "", above_zero, &L::courant_number,
        "a step in which waves, as fast as they are at its end, cross more cells than this has gone wrong: matter has "
        "grown too stiff for it (see `/time/redos`; times the `multiplier` where that is above 1)",
        true},
       {"redone_steps", "", zero_or_above, &L::redone_steps, "warns beyond: refused tries of steps, over all steps",
        true},
       {"missed_substeps", "", part, &L::missed_substeps,
        "warns beyond: the part of the materials' substeps that missed their tolerance, from 100 substeps a particle "
        "on",
        true},
       {"swollen_load", "", part, &L::swollen_load,
        "warns beyond: the greatest part of the mass that has swollen to more than 1.2 times its first volume and yet "
        "bears more than a hundredth of the greatest load in any sample",
        true},
       {"looser_than_tested", "", part, &L::looser_than_tested,
        "warns beyond: the largest load (sum of V p) on sand that has dilated until it is looser than any that was "
        "tested, over the largest load on all sand in a sample",
        true},
       {"out_of_range", "", part, &L::out_of_range,
        "warns beyond: the part of the updates that ended in compression beyond the largest strains that the modulus "
        "was made for",
        true},
       {"energy_drift", "", zero_or_above, &L::energy_drift,
        "warns beyond: the error of the energy at the end, over what the run has been given", true},
       {"momentum_error", "", zero_or_above, &L::momentum_error,
        "warns beyond: momentum without a cause, over the largest sum of m v", true},
       {"filtered_energy", "", zero_or_above, &L::filtered_energy,
        "warns beyond: the energy lost in the transfer, over what the run has been given", true},
       {"damped_energy", "", zero_or_above, &L::damped_energy,
        "warns beyond: the energy that local damping took, as far as motion, plastic strain and friction stand beside "
        "it, over what the run has been given",
        true},
       {"null_space", "", part, &L::null_space,
        "warns beyond: the part of the kinetic and elastic energy in motion that no node sees, over all samples", true},
       {"uneven_pressure", "", part, &L::uneven_pressure,
        "warns beyond: how far the pressures of particles are from the means of their cells, V (p - p_c)^2 over V p^2, "
        "over all samples",
        true},
       {"torn_apart", "", part, &L::torn_apart,
        "warns beyond: the greatest part of elastic particles that hold tension across more than 1.2 cells", true},
       {"early_contact", "", part, &L::early_contact,
        "warns beyond: the part of the contact impulses between materials that are more than a quarter of a cell "
        "apart, over all samples",
        true},
       {"early_at_walls", "", part, &L::early_at_walls,
        "warns beyond: the part of the loads on walls with an image that comes from matter more than a quarter of a "
        "cell away, over all samples",
        true},
       {"interpenetration", "", part, &L::interpenetration,
        "warns beyond: the part of the contact impulses between materials that overlap by more than half a cell, over "
        "all samples",
        true},
       {"lost_mass", "", part, &L::lost_mass, "warns beyond: the part of the mass that has left the grid", true},
       {"forecast_missed",
        "",
        {.lower = 1},
        &L::forecast_missed,
        "warns beyond: the factor by which a run took more memory or disk space than was forecast, or more or fewer "
        "steps",
        true},
       {"sampled_every",
        "",
        {.lower = 1, .upper = 1e6},
        &L::sampled_every,
        "steps between the samples of `null_space`, `uneven_pressure`, `torn_apart`, `swollen_load`, "
        "`looser_than_tested`, `early_contact`, `early_at_walls` and `interpenetration`",
        true}}};
}

}  // namespace tamp::tasks
