#include <fmt/format.h>

#include <chrono>

#include "tasks/simulation.hpp"
#include "tools/bench/bench.hpp"
#include "tools/bench/triad.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

constexpr int punch_steps = 200;
constexpr int punch_rounds = 5;

/// Runs the first steps and returns the time of each [s]; `record(step)` says whether the step is recorded.
template <class Record>
std::vector<double> step_seconds(const tasks::Scene& scene, int n_threads, const Record& record)
{
  const auto simulation = tasks::Simulation::make(scene, n_threads);
  std::vector<double> seconds;
  for (int step = 0; step < punch_steps; ++step) {
    simulation->record(record(step));
    const auto start = std::chrono::steady_clock::now();
    simulation->advance(scene.time.end);
    seconds.push_back(std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
  }
  return seconds;
}

double sum(const std::vector<double>& values)
{
  double total = 0;
  for (const double v : values) total += v;
  return total;
}

/// Each particle array read once and written once: bytes per particle, the mean over all particles.
double least_bytes(const tasks::Scene& scene)
{
  const auto simulation = tasks::Simulation::make(scene, 1);
  double bytes = 0;
  double particles = 0;
  for (int m = 0; m < static_cast<int>(scene.materials.size()); ++m) {
    const auto n = static_cast<double>(simulation->n_particles(m));
    bytes += n * static_cast<double>(simulation->least_bytes_per_particle(m));
    particles += n;
  }
  return bytes / particles;
}

}  // namespace

Result punch(const std::filesystem::path& file)
{
  const tasks::Scene scene = read_scene(file).scene;
  double particles = 0;
  for (const tasks::SceneBody& body : scene.bodies) particles += static_cast<double>(body.n_particles);

  std::vector<double> one_thread;
  std::vector<double> two_threads;
  std::vector<double> recording;
  std::vector<double> bandwidth;
  const auto always = [](int) { return true; };
  for (int round = 0; round < punch_rounds; ++round) {
    bandwidth.push_back(triad_bytes_per_second());
    one_thread.push_back(sum(step_seconds(scene, 1, always)));
    two_threads.push_back(sum(step_seconds(scene, 2, always)));
    // Neighbouring steps do the same work: each recorded one is compared with the one after it, which is not.
    const std::vector<double> turns = step_seconds(scene, 1, [](int step) { return step % 2 == 0; });
    for (std::size_t step = 0; step + 1 < turns.size(); step += 2) recording.push_back(turns[step] / turns[step + 1]);
  }

  const double ns = median(one_thread) / punch_steps / particles * 1e9;
  const double triad = median(bandwidth);
  const double bytes = least_bytes(scene);
  const double bound_ns = bytes / triad * 1e9;
  const double efficiency = median(one_thread) / (2 * median(two_threads));
  const double overhead = median(recording) - 1;
  Result result;
  result.json = {{"ns_per_particle_step", ns},
                 {"triad_gb_per_s", triad * 1e-9},
                 {"min_bytes_per_particle_step", bytes},
                 {"bound_ns", bound_ns},
                 {"ratio_to_bound", ns / bound_ns},
                 {"recording_overhead", overhead},
                 {"efficiency_2_threads", efficiency},
                 {"particles", particles},
                 {"steps", punch_steps},
                 {"rounds", punch_rounds}};
  result.text = fmt::format(
      "punch: {:.0f} particles, {} steps, median of {} rounds\n"
      "  {:<44} {:>10.1f} ns\n  {:<44} {:>10.2f} GB/s\n  {:<44} {:>10.1f}\n  {:<44} {:>10.2f} ns\n"
      "  {:<44} {:>10.1f}\n  {:<44} {:>10.3f}\n  {:<44} {:>9.2f} %\n",
      particles, punch_steps, punch_rounds, "time per particle and step, 1 thread", ns, "triad bandwidth, 1 thread",
      triad * 1e-9, "bytes a particle-step must move", bytes, "time they need", bound_ns, "ratio of the two times",
      ns / bound_ns, "parallel efficiency of 2 threads", efficiency, "cost of recording", overhead * 100);
  return result;
}

}  // namespace tamp::tools::bench
