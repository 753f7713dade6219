#include "tools/run/monitors.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace tamp::tools
{

namespace
{

double ratio(double part, double whole)
{
  return whole > 0 ? part / whole : 0;
}

template <class Count>
double number(Count count)
{
  return static_cast<double>(count);
}

std::vector<Monitor> of_steps(const tasks::Simulation& simulation)
{
  const tasks::SceneLimits& limits = simulation.scene().limits;
  const components::UpdateCounts& updates = simulation.updates();
  const tasks::Occurrences& refused = simulation.refused();
  const tasks::MonitorRecords& seen = simulation.monitors();
  return {
      {"redone_steps", number(refused.count), ratio(number(refused.count), number(simulation.n_steps())),
       limits.redone_steps, refused,
       "of the steps failed and were repeated with shorter ones; a smaller /time/multiplier avoids that"},
      {"missed_substeps", number(updates.limited_substeps),
       tasks::missed_substeps(updates, simulation.scene().n_particles()), limits.missed_substeps, seen.missed_substeps,
       "of the substeps of the materials missed their tolerance: the stress is less accurate than requested; a smaller "
       "/time/multiplier makes the strains of a step smaller"},
      {"out_of_range", number(tasks::n_out_of_range(updates)), tasks::out_of_range(updates), limits.out_of_range,
       seen.out_of_range,
       "of the stress updates ended in compression beyond the largest strains that the modulus was made for, or beyond "
       "the pressure at which real grains crush: results are uncertain as far as such sand carries load; measurements "
       "to larger strains would help"}};
}

std::vector<Monitor> of_balances(const tasks::Simulation& simulation, const RunHistory& history)
{
  const tasks::SceneLimits& limits = simulation.scene().limits;
  const BalanceShares now = history.balances();
  const BalanceSightings& above = history.balances_above();
  return {{"energy_drift",
           {},
           now.energy_drift,
           limits.energy_drift,
           above.energy_drift,
           "of the energy given to the run is missing, or in excess, at its end: a smaller /time/multiplier, or "
           "another transfer or stress timing, conserves it better"},
          {"momentum_error",
           {},
           now.momentum_error,
           limits.momentum_error,
           above.momentum_error,
           "of the largest momentum has no cause"},
          {"filtered_energy",
           {},
           now.filtered_energy,
           limits.filtered_energy,
           above.filtered_energy,
           "of the energy given to the run was lost in the transfer, which acts like a viscosity that grows with the "
           "cells; smaller cells or a transfer that filters less (flip, tflip) lose less"},
          {"damped_energy",
           {},
           now.damped_energy,
           limits.damped_energy,
           above.damped_energy,
           "of the energy given to the run was taken by local damping, which also brakes flight, sliding and impact; a "
           "smaller /local_damping takes less"},
          {"lost_mass", number(simulation.lost().count), now.lost_mass, limits.lost_mass, above.lost_mass,
           "of the mass has left the grid and no longer acts on anything; a larger grid keeps it"}};
}

/// The monitors of samples of the state. A single torn state is enough for a warning; the others have to last.
std::vector<Monitor> of_samples(const tasks::Simulation& simulation)
{
  const tasks::SceneLimits& limits = simulation.scene().limits;
  const tasks::MonitorRecords& seen = simulation.monitors();
  const auto monitor = [](const char* name, const tasks::SampledShare& record, double share, double limit,
                          const char* words) -> Monitor {
    return {name, number(record.above.count), share, limit, record.above, words};
  };
  return {monitor("null_space", seen.null_space, seen.null_space.all.value(), limits.null_space,
                  "of the kinetic and elastic energy is in motion that no node sees, so that nothing stops it; "
                  "transfers that filter (apic, fmpm) remove it"),
          monitor("uneven_pressure", seen.uneven_pressure, seen.uneven_pressure.all.value(), limits.uneven_pressure,
                  "of the squared pressure differs between the particles of a cell: matter that hardly changes its "
                  "volume locks; /anti_locking or splines prevent that"),
          monitor("torn_apart", seen.torn_apart, seen.torn_apart.greatest, limits.torn_apart,
                  "of the elastic particles hold tension across more than 1.2 cells, where no node joins them: the "
                  "break is numerical; cpdi, or more particles a cell, prevent it"),
          monitor("swollen_load", seen.swollen_load, seen.swollen_load.greatest, limits.swollen_load,
                  "of the mass has swollen by more than a fifth and yet bears load: its material counts the gaps that "
                  "opened in it as volume, so that heights, densities and the load on such matter come out too large"),
          {"looser_than_tested", number(seen.looser_than_tested.above.count), seen.looser_than_tested.greatest.value(),
           limits.looser_than_tested, seen.looser_than_tested.above,
           "of the largest load on the sand was borne by sand that has dilated until it is looser than any sample "
           "tested, so that its stiffness is a guess; tests of looser samples would help, and the material's "
           "separation lets light sand come apart"},
          monitor("early_contact", seen.early_contact, seen.early_contact.all.value(), limits.early_contact,
                  "of the contact impulses act between bodies more than a quarter of a cell apart; with the normal "
                  "\"regression\" bodies push only where they touch"),
          monitor("early_at_walls", seen.early_at_walls, seen.early_at_walls.all.value(), limits.early_at_walls,
                  "of the loads on walls come from matter more than a quarter of a cell away; a wall with \"at_edges\" "
                  "stops matter where it touches"),
          monitor("interpenetration", seen.interpenetration, seen.interpenetration.all.value(), limits.interpenetration,
                  "of the contact impulses act between bodies that overlap by more than half a cell along their "
                  "normal; the normal of another surface, or \"regression\", finds their contact better")};
}

Monitor of_forecast(const tasks::SceneLimits& limits, const ForecastMiss& missed)
{
  return {"forecast_missed",
          {},
          missed.factor,
          limits.forecast_missed,
          {},
          "times off: the forecast of the run's " + missed.what +
              ", which was made on coarser cells and assumes no growth; watch what a longer run of this scene takes",
          true};
}

/// How close the share is to its limit, or how far beyond.
double badness(const Monitor& monitor)
{
  const double best = monitor.is_factor ? 1 : 0;
  if (monitor.limit > best) return (monitor.share - best) / (monitor.limit - best);
  return monitor.share > best ? HUGE_VAL : 0;
}

const std::string& material_name(const tasks::Scene& scene, int material)
{
  return scene.materials[static_cast<std::size_t>(material)].name;
}

nlohmann::ordered_json first_of(const tasks::Occurrences& seen, const tasks::Scene& scene)
{
  if (seen.first_step < 0) return nullptr;
  nlohmann::ordered_json json{{"after_step", seen.first_step}, {"time_s", seen.first_time}};
  const tasks::ParticlePlace& place = seen.first;
  if (place.particle < 0) return json;
  if (place.other_material >= 0) {
    json["materials"] = {material_name(scene, place.material), material_name(scene, place.other_material)};
  } else {
    json["particle"] = place.particle;
    json["material"] = material_name(scene, place.material);
  }
  json["position_m"] = std::vector(place.position.begin(), place.position.begin() + scene.grid.dimension);
  return json;
}

std::string place_of_first(const tasks::Occurrences& seen, const tasks::Scene& scene)
{
  if (seen.first_step < 0) return "";
  std::string words = fmt::format(", first after step {}, time {:.4g} s", seen.first_step, seen.first_time);
  const tasks::ParticlePlace& place = seen.first;
  if (place.particle < 0) return words;
  const std::string who = place.other_material >= 0 ? fmt::format("'{}' and '{}'", material_name(scene, place.material),
                                                                  material_name(scene, place.other_material))
                                                    : fmt::format("particle {} of '{}'", place.particle,
                                                                  material_name(scene, place.material));
  const auto& x = place.position;
  return words + fmt::format(", {} at ({:.4g}) m", who, fmt::join(x.begin(), x.begin() + scene.grid.dimension, ", "));
}

}  // namespace

std::vector<Monitor> monitors_of(const tasks::Simulation& simulation, const RunHistory& history,
                                 const ForecastMiss& missed)
{
  std::vector<Monitor> all = of_steps(simulation);
  for (auto&& more : {of_balances(simulation, history), of_samples(simulation)}) {
    all.insert(all.end(), more.begin(), more.end());
  }
  all.push_back(of_forecast(simulation.scene().limits, missed));
  std::ranges::stable_sort(all, std::greater(), badness);
  return all;
}

std::string warning_of(const Monitor& monitor, const tasks::Scene& scene)
{
  const auto amount = [&](double share) {
    // Two digits, but no exponent where these end before the point.
    const double shown = monitor.is_factor ? share : 100 * share;
    return fmt::format(fmt::runtime(shown < 99.5 ? "{:.2g}{}" : "{:.0f}{}"), shown, monitor.is_factor ? "" : " %");
  };
  return fmt::format("{} {} (more than /limits/{}, {}{})", amount(monitor.share), monitor.words, monitor.name,
                     amount(monitor.limit), place_of_first(monitor.first, scene));
}

nlohmann::ordered_json to_json(const Monitor& monitor, const tasks::Scene& scene)
{
  return {{"count", monitor.count ? nlohmann::ordered_json(*monitor.count) : nlohmann::ordered_json(nullptr)},
          {"share", monitor.share},
          {"limit", monitor.limit},
          {"warns", monitor.warns()},
          {"first", first_of(monitor.first, scene)}};
}

}  // namespace tamp::tools
