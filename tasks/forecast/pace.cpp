#include "tasks/forecast/pace.hpp"

#include <algorithm>
#include <cstdint>
#include <ctime>
#include <exception>
#include <utility>
#include <vector>

#include "components/portable_math.hpp"
#include "tasks/forecast/demand.hpp"
#include "tasks/forecast/own_steps.hpp"
#include "tasks/simulation.hpp"

namespace tamp::tasks
{

namespace
{

/// The scene on a grid of cells `factor` times as large; nothing if that is no whole number of them.
std::optional<Scene> coarsened(const Scene& scene, int factor)
{
  Scene coarse = scene;
  coarse.n_patches = {1, 1, 1};
  coarse.grid.cell_size *= factor;
  for (std::size_t k = 0; k < static_cast<std::size_t>(scene.grid.dimension); ++k) {
    const int n_cells = scene.grid.n_cells[k] / factor;
    if (scene.grid.n_cells[k] % factor != 0) return std::nullopt;
    if (factor > 1 && n_cells < least_patch_width(scene.interpolator)) return std::nullopt;
    coarse.grid.n_cells[k] = n_cells;
    for (SceneBody& body : coarse.bodies) body.n_particles /= static_cast<std::size_t>(factor);
  }
  return coarse;
}

/// The progress of a run: the part of its time that it has completed, and its steps and processor time [s] until then.
struct Progress {
  double part = 0;
  double n_steps = 0;
  /// Number of steps that the scene takes on its own cells for the same part.
  double own_steps = 0;
  double seconds = 0;
};

/// A trial on cells `factor` times as large, step by step.
struct Trial {
  int factor = 1;
  std::vector<Progress> progress;

  const Progress& end() const { return progress.back(); }
  bool complete() const { return end().part == 1; }
  /// When it had come as far as this.
  const Progress& at(double part) const
  {
    return *std::find_if(progress.begin(), progress.end() - 1, [&](const Progress& p) { return p.part >= part; });
  }
};

/// Processor time of this program [s], so that other programs of the machine do not count as a cost of the run.
double processor_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Runs `coarse`, the scene on coarser cells, as far as it comes in so much processor time; empty if it lacks one of
/// the bodies.
std::optional<Trial> tried(const Scene& scene, const Scene& coarse, int factor, double seconds)
{
  const auto simulation = Simulation::make(coarse, 1);
  for (const SceneBody& body : coarse.bodies) {
    if (simulation->n_particles(body.material) == 0) return std::nullopt;
  }
  simulation->engine().record(false);
  const double start = processor_seconds();
  Trial trial{factor, {{}}};
  OwnSteps own(scene, factor);
  while (!trial.complete() && trial.end().seconds < seconds) {
    own.before(*simulation);
    simulation->advance(scene.time.end);
    own.after(*simulation);
    trial.progress.push_back({simulation->time() / scene.time.end, static_cast<double>(simulation->n_steps()),
                              own.count(), processor_seconds() - start});
  }
  return trial;
}

/// Ratio of the steps of a whole trial to its steps so far, extrapolated from its last tenth: sand that has been
/// compacted stays so, and keeps its faster waves.
double until_end(const Trial& trial)
{
  const Progress &reached = trial.end(), &late = trial.at(0.9 * reached.part);
  if (trial.complete() || !(reached.part > late.part)) return 1 / reached.part;
  const double rate = (reached.own_steps - late.own_steps) / (reached.part - late.part);
  return 1 + rate * (1 - reached.part) / reached.own_steps;
}

/// Extrapolates to the end of the run on the scene's own cells. A coarser trial that was complete tells how the finer
/// one would have gone on, and with which power of the cell size the cost of a particle in a step grows: each step has
/// costs of its own, and in a longer step more of the sand takes more substeps.
Pace extrapolated(const Trial& fine, const Trial* coarse, int dimension)
{
  const Progress& reached = fine.end();
  const double more = until_end(fine);
  double own_steps = reached.own_steps * more, more_steps = more, more_seconds = more, power = 0;
  if (coarse != nullptr) {
    constexpr double greatest_power = 0.35;  // chosen by the runs in results/failures/forecasts.csv
    const Progress &there = coarse->at(reached.part), &end = coarse->end();
    // Adds the steps still to come, rather than scaling those so far: bodies touch a little sooner or later on other
    // cells.
    own_steps = reached.own_steps + end.own_steps - there.own_steps;
    more_steps = end.n_steps / there.n_steps;
    more_seconds = end.seconds / there.seconds;
    const double coarser = static_cast<double>(coarse->factor) / fine.factor;
    const double dearer =
        there.seconds / there.n_steps * portable::pow(coarser, dimension) / (reached.seconds / reached.n_steps);
    power = std::clamp(portable::log(dearer) / portable::log(coarser), 0.0, greatest_power);
  }
  const double seconds_of_step = reached.seconds * more_seconds / (reached.n_steps * more_steps);
  return {own_steps, own_steps * seconds_of_step * portable::pow(fine.factor, dimension - power)};
}

Pace extrapolated(const std::vector<Trial>& trials, int dimension)
{
  // On cells that are larger still a body of some cells is another one.
  constexpr int coarsest = 4;
  const Trial& fine = trials.back();
  const Trial* const coarse = trials.size() > 1 ? &trials[trials.size() - 2] : nullptr;
  const bool tells = coarse != nullptr && coarse->factor < coarsest * fine.factor;
  return extrapolated(fine, tells ? coarse : nullptr, dimension);
}

/// Whether the scene's fields are too large to be laid out within the time. Counting them takes a while, too; a small
/// grid is never too large.
bool is_too_large(const Scene& scene)
{
  constexpr std::int64_t small = 100'000;
  constexpr double most_bytes = 3e8;
  return scene.grid.cells().size() > small && demand_of(scene).fields > most_bytes;
}

/// From coarse cells to fine ones, until the time is up or one did not come to its end.
std::vector<Trial> trials_of(const Scene& scene, const Effort& effort)
{
  // More particles cannot be laid out and begun within the time.
  constexpr double most_particles = 150'000;
  constexpr int greatest_factor = 32;
  // However short the run is, nobody notices a forecast of this time [s].
  constexpr double unnoticed = 0.1;
  double n_particles = 0;
  for (const SceneBody& body : scene.bodies) n_particles += static_cast<double>(body.n_particles);
  const double start = processor_seconds();
  double seconds = effort.seconds;
  std::vector<Trial> trials;
  for (int factor = greatest_factor; factor >= 1; --factor) {
    const double left = start + seconds - processor_seconds();
    if (n_particles / portable::pow(factor, scene.grid.dimension) > most_particles || left <= 0) break;
    // Cells that are nearly as large as the last tell little more.
    const bool is_worth_it = trials.empty() || factor == 1 || 2 * factor <= trials.back().factor;
    const auto coarse = is_worth_it ? coarsened(scene, factor) : std::nullopt;
    if (!coarse || is_too_large(*coarse)) continue;
    try {
      if (auto trial = tried(scene, *coarse, factor, left)) trials.push_back(std::move(*trial));
    } catch (const std::exception&) {
      continue;  // too coarse for something; what is wrong with the scene itself shows in its run
    }
    if (trials.empty()) continue;
    if (!trials.back().complete()) break;
    if (!(effort.part_of_run < 1)) continue;
    const double of_run = effort.part_of_run * extrapolated(trials, scene.grid.dimension).core_seconds;
    seconds = std::min(seconds, std::max(of_run, unnoticed));
  }
  return trials;
}

}  // namespace

std::optional<Pace> pace_of(const Scene& scene, const Effort& effort)
{
  std::vector<Trial> trials = trials_of(scene, effort);
  if (trials.empty()) return std::nullopt;
  // Less of a run tells less than a coarser one that was complete.
  constexpr double least_part = 0.1;
  if (trials.size() > 1 && trials.back().end().part < least_part) trials.pop_back();
  return extrapolated(trials, scene.grid.dimension);
}

}  // namespace tamp::tasks
