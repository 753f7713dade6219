#include "tasks/forecast/pace.hpp"

#include <algorithm>
#include <ctime>
#include <exception>
#include <utility>
#include <vector>

#include "components/portable_math.hpp"
#include "tasks/forecast/demand.hpp"
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

/// How far a run came, and what it took until then.
struct Progress {
  double part = 0;
  double n_steps = 0;
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

/// Processor time of this program [s]: what else the machine does is no cost of a run.
double processor_seconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

/// Runs a scene as far as it comes in so much processor time; nothing if it has not all the bodies.
std::optional<Trial> tried(const Scene& scene, int factor, double seconds)
{
  const auto simulation = Simulation::make(scene, 1);
  for (const SceneBody& body : scene.bodies) {
    if (simulation->n_particles(body.material) == 0) return std::nullopt;
  }
  simulation->engine().record(false);
  const double start = processor_seconds();
  Trial trial{factor, {{}}};
  while (!trial.complete() && trial.end().seconds < seconds) {
    simulation->advance(scene.time.end);
    trial.progress.push_back(
        {simulation->time() / scene.time.end, static_cast<double>(simulation->n_steps()), processor_seconds() - start});
  }
  return trial;
}

/// To the end on the scene's own cells. A coarser trial that was complete tells how the finer one would have gone on,
/// and by which power of the cell size a particle's part of a step gets dearer: a step has costs of its own, and in a
/// longer one more of the sand takes more substeps.
Pace extrapolated(const Trial& fine, const Trial* coarse, int dimension)
{
  const Progress& reached = fine.end();
  double more_steps = 1 / reached.part, more_seconds = 1 / reached.part, power = 0;
  if (coarse != nullptr) {
    constexpr double greatest_power = 0.35;  // chosen by the runs in docs/failures.md
    const Progress &there = coarse->at(reached.part), &end = coarse->end();
    more_steps = end.n_steps / there.n_steps;
    more_seconds = end.seconds / there.seconds;
    const double coarser = static_cast<double>(coarse->factor) / fine.factor;
    const double dearer =
        there.seconds / there.n_steps * portable::pow(coarser, dimension) / (reached.seconds / reached.n_steps);
    power = std::clamp(portable::log(dearer) / portable::log(coarser), 0.0, greatest_power);
  }
  return {reached.n_steps * more_steps * fine.factor,
          reached.seconds * more_seconds * portable::pow(fine.factor, dimension + 1 - power)};
}

Pace extrapolated(const std::vector<Trial>& trials, int dimension)
{
  return extrapolated(trials.back(), trials.size() > 1 ? &trials[trials.size() - 2] : nullptr, dimension);
}

/// From coarse cells to fine ones, until the time is up or one did not come to its end.
std::vector<Trial> trials_of(const Scene& scene, const Effort& effort)
{
  // More are not laid out and begun within the time.
  constexpr double most_particles = 150'000, most_bytes = 3e8;
  constexpr int greatest_factor = 32;
  double n_particles = 0;
  for (const SceneBody& body : scene.bodies) n_particles += static_cast<double>(body.n_particles);
  const double start = processor_seconds();
  double seconds = effort.seconds;
  std::vector<Trial> trials;
  for (int factor = greatest_factor; factor >= 1; --factor) {
    const double left = start + seconds - processor_seconds();
    if (n_particles / portable::pow(factor, scene.grid.dimension) > most_particles || left <= 0) break;
    const auto coarse = coarsened(scene, factor);
    if (!coarse || demand_of(*coarse).fields > most_bytes) continue;
    try {
      if (auto trial = tried(*coarse, factor, left)) trials.push_back(std::move(*trial));
    } catch (const std::exception&) {
      continue;  // too coarse for something; what is wrong with the scene itself shows in its run
    }
    if (trials.empty()) continue;
    if (!trials.back().complete()) break;
    seconds = std::min(seconds, effort.part_of_run * extrapolated(trials, scene.grid.dimension).core_seconds);
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
