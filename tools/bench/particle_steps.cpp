#include "tools/bench/particle_steps.hpp"

#include <chrono>
#include <stdexcept>

#include "tools/system/processor_time.hpp"

namespace tamp::tools::bench
{

namespace
{

using WallClock = std::chrono::steady_clock;

/// Takes the time of steps of a simulation from here on. Its profile must be new. Tasks are timed by the clock on the
/// wall, in which other programs take their part: a phase gets of the processor time what it has of the other.
class StepsClock
{
 public:
  explicit StepsClock(const tasks::Simulation& simulation)
      : simulation_(simulation),
        updates_(simulation.updates()),
        first_step_(simulation.n_steps()),
        start_(process_seconds()),
        wall_start_(WallClock::now())
  {
  }

  /// Runs `work` without counting its time.
  template <class Work>
  void pause(const Work& work)
  {
    const double begin = process_seconds();
    const WallClock::time_point wall_begin = WallClock::now();
    work();
    start_ += process_seconds() - begin;
    wall_start_ += WallClock::now() - wall_begin;
  }

  StepsTime time() const
  {
    const double seconds = process_seconds() - start_;
    const double wall = std::chrono::duration<double>(WallClock::now() - wall_start_).count();
    const long n_steps = simulation_.n_steps() - first_step_;
    const double updates = particles_of(simulation_.scene()) * static_cast<double>(n_steps);
    StepsTime time{
        n_steps, wall, seconds / wall, seconds / updates * 1e9, 0, {}, least_work(simulation_, updates_, n_steps)};
    time.ns_between_tasks = time.ns;
    for (const runtime::TaskStatistics& task : simulation_.engine().profile().tasks) {
      const double ns = task.total_s * seconds / wall * 1e9;
      time.phases.push_back({task.name, ns / updates, task.particles > 0 ? ns / task.particles : 0});
      time.ns_between_tasks -= time.phases.back().ns;
    }
    return time;
  }

 private:
  const tasks::Simulation& simulation_;
  components::UpdateCounts updates_;
  long first_step_;
  double start_;
  WallClock::time_point wall_start_;
};

WindowStart kept_start(tasks::Simulation& simulation, const Window& window, const std::filesystem::path& folder)
{
  const std::filesystem::path own = folder / window.name;
  simulation.engine().write_checkpoint(own, "", {}, 1);
  std::vector<std::string> refused;
  auto found = runtime::newest_checkpoint(own, refused);
  if (!found) throw std::logic_error("a checkpoint that was just written is not there");
  return {window, *std::move(found), simulation.updates()};
}

}  // namespace

double particles_of(const tasks::Scene& scene)
{
  double n = 0;
  for (const tasks::SceneBody& body : scene.bodies) n += static_cast<double>(body.n_particles);
  return n;
}

WholeRun run_whole(const tasks::Scene& scene, std::span<const Window> windows, const std::filesystem::path& folder)
{
  const auto simulation = tasks::Simulation::make(scene, 1);
  WholeRun run;
  StepsClock clock(*simulation);
  while (simulation->time() < scene.time.end) {
    clock.pause([&] {
      while (run.starts.size() < windows.size() &&
             simulation->time() >= windows[run.starts.size()].begin * scene.time.end) {
        run.starts.push_back(kept_start(*simulation, windows[run.starts.size()], folder));
      }
    });
    simulation->advance(scene.time.end);
  }
  run.time = clock.time();
  return run;
}

std::unique_ptr<tasks::Simulation> at_start(const tasks::Scene& scene, const WindowStart& start, int n_threads)
{
  auto simulation = tasks::Simulation::make(scene, n_threads);
  simulation->engine().restart(start.checkpoint);
  return simulation;
}

StepsTime steps_from(const tasks::Scene& scene, const WindowStart& start, long n_steps, int n_threads)
{
  const auto simulation = at_start(scene, start, n_threads);
  const long last = simulation->n_steps() + n_steps;
  const StepsClock clock(*simulation);
  while (simulation->n_steps() < last && simulation->time() < scene.time.end) simulation->advance(scene.time.end);
  return clock.time();
}

}  // namespace tamp::tools::bench
