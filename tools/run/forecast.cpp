#include "tools/run/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tasks/forecast/demand.hpp"
#include "tools/system/capacity.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

/// Further memory of a process, once its first particles are laid out [bytes].
constexpr double of_libraries = 6.5e6;
/// The profile and trace of a run, and the text of its history [bytes].
constexpr double of_reports = 2e6;

/// A time in words, such as "300 core-seconds (5 min of one core)".
std::string in_time(double seconds)
{
  if (seconds < 90) return fmt::format("{:.0f} core-seconds", seconds);
  if (seconds < 5400) return fmt::format("{:.0f} core-seconds ({:.0f} min of one core)", seconds, seconds / 60);
  return fmt::format("{:.3g} core-seconds ({:.3g} h of one core)", seconds, seconds / 3600);
}

}  // namespace

Forecast forecast(const tasks::Scene& scene, int n_ranks)
{
  const double resident = resident_bytes();
  const tasks::Demand demand = demand_of(scene, n_ranks);
  const double n_outputs = std::ceil(scene.time.end / scene.output.fields_interval) + 1;
  Forecast all;
  all.n_particles = demand.n_particles;
  all.at_start = n_ranks * resident;
  all.memory = all.at_start + n_ranks * of_libraries + demand.graph + demand.fields + demand.output_room;
  // One copy at a time; on several ranks the first rank holds it beside those of the others.
  all.copies = (n_ranks > 1 ? 2 : 1) * std::max(demand.output_room, demand.checkpoint_file) - demand.output_room;
  all.disk = n_outputs * demand.output_file + n_checkpoints_forecast * demand.checkpoint_file + of_reports;
  return all;
}

void expect_room(const CheckedScene& checked, const Forecast& forecast, int n_ranks, int ranks_here)
{
  const tasks::Scene& scene = checked.scene;
  const FreeMemory room = free_memory(ranks_here);
  const double needed = forecast.memory * ranks_here / n_ranks;
  if (needed <= room.bytes) return;
  constexpr double a_little_more = 1.05;
  const double fitting = scene.grid.cell_size * std::pow(needed / room.bytes, 1.0 / scene.grid.dimension);
  throw InputError(
      {checked.inputs.front().file.string() + "#/grid/cell_size",
       fmt::format("{} m: {} particles, {} of memory", scene.grid.cell_size, forecast.n_particles, in_bytes(needed)),
       fmt::format("expected at most the {} that {}, as with cells of {:.2g} m", in_bytes(room.bytes), room.why,
                   a_little_more * fitting)});
}

void add_copies(Forecast& forecast, int n_ranks, int ranks_here)
{
  const double without = forecast.memory * ranks_here / n_ranks;
  forecast.in_background = without + forecast.copies <= free_memory(ranks_here).bytes;
  if (forecast.in_background) forecast.memory += forecast.copies;
}

void add_pace(const tasks::Scene& scene, const tasks::Effort& effort, Forecast& forecast)
{
  forecast.pace = tasks::pace_of(scene, effort);
}

ForecastMiss miss_of(const Forecast& forecast, const UsedByRun& taken)
{
  ForecastMiss worst;
  const auto look = [&](double factor, const char* what) {
    if (factor > worst.factor) worst = {factor, what};
  };
  if (forecast.memory > forecast.at_start) look(taken.memory / (forecast.memory - forecast.at_start), "memory");
  if (forecast.disk > 0) look(taken.disk / forecast.disk, "disk space");
  if (!forecast.pace || !taken.n_steps || *taken.n_steps == 0 || forecast.pace->n_steps == 0) return worst;
  const double steps = static_cast<double>(*taken.n_steps) / forecast.pace->n_steps;
  look(std::max(steps, 1 / steps), "steps");
  return worst;
}

std::string description(const Forecast& forecast)
{
  std::string text = fmt::format("forecast: {} particles, {} of memory, {} on the disk", forecast.n_particles,
                                 in_bytes(forecast.memory), in_bytes(forecast.disk));
  if (!forecast.in_background) text += " (no room for copies: steps wait while output is written)";
  if (forecast.pace) {
    text += fmt::format(", about {:.2g} steps, {}", forecast.pace->n_steps, in_time(forecast.pace->core_seconds));
  }
  return text;
}

}  // namespace tamp::tools
