#include "tasks/demand.hpp"

#include <algorithm>
#include <array>
#include <ctime>
#include <numeric>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "components/portable_math.hpp"
#include "runtime/data/warehouse.hpp"
#include "tasks/engine.hpp"
#include "tasks/simulation.hpp"

namespace tamp::tasks
{

namespace
{

std::vector<std::size_t> particles_of_materials(const Scene& scene)
{
  std::vector<std::size_t> n(scene.materials.size());
  for (const SceneBody& body : scene.bodies) n[static_cast<std::size_t>(body.material)] += body.n_particles;
  return n;
}

/// Numbers that a particle has in an output file, see FieldColumns.
int n_output_numbers(const SceneMaterial& material)
{
  constexpr int id = 1, vectors = 2 * 3, stress = 6, scalars = 4, of_sand = 4;
  return id + vectors + stress + scalars +
         (std::holds_alternative<components::TabularCap>(material.model) ? of_sand : 0);
}

template <class Interpolator>
double field_bytes(const Scene& scene, const std::vector<std::size_t>& n_particles)
{
  const Method<Interpolator> method(scene);
  std::vector<std::string> names;
  for (const SceneMaterial& material : scene.materials) names.push_back(material.name);
  const runtime::PatchLayout layout(scene.grid, scene.n_patches);
  const auto host = host_data(method);
  const runtime::TaskGraph step(time_step(method, [](const StepTotals&) { return true; }), layout, names, host);
  const runtime::TaskGraph report(report_tasks(method), layout, names, {host.state, {&particle_report, &nose_report}});
  return runtime::Warehouse::forecast_bytes(std::array<const runtime::TaskGraph*, 2>{&step, &report}, n_particles);
}

/// The scene on a grid of cells `factor` times as large; nothing if that is no whole number of them.
std::optional<Scene> coarsened(const Scene& scene, int factor)
{
  Scene coarse = scene;
  coarse.n_patches = {1, 1, 1};
  coarse.grid.cell_size *= factor;
  for (std::size_t k = 0; k < static_cast<std::size_t>(scene.grid.dimension); ++k) {
    if (scene.grid.n_cells[k] % factor != 0 || scene.grid.n_cells[k] / factor < least_patch_width) return std::nullopt;
    coarse.grid.n_cells[k] /= factor;
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
  simulation->record(false);
  const double start = processor_seconds();
  Trial trial{factor, {{}}};
  while (!trial.complete() && trial.progress.back().seconds < seconds) {
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
    constexpr double greatest_power = 0.35;  // of the runs in docs/failures.md
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

}  // namespace

Demand demand_of(const Scene& scene)
{
  const std::vector<std::size_t> n_particles = particles_of_materials(scene);
  Demand demand;
  double n_nodes = 1;
  for (int k = 0; k < scene.grid.dimension; ++k) n_nodes *= scene.grid.n_cells[static_cast<std::size_t>(k)] + 1;
  constexpr double bytes_of_number = 8;
  demand.output_file = 4 * bytes_of_number * n_nodes;
  for (std::size_t m = 0; m < n_particles.size(); ++m) {
    demand.n_particles += n_particles[m];
    demand.output_file += bytes_of_number * n_output_numbers(scene.materials[m]) * static_cast<double>(n_particles[m]);
  }
  demand.fields = scene.grid.dimension == 2 ? field_bytes<components::Gimp<2>>(scene, n_particles)
                                            : field_bytes<components::Gimp<3>>(scene, n_particles);
  // Vectors that grow as they are filled have room to spare.
  demand.output_room = 1.3 * demand.output_file;
  // The state, without what the next step makes of it.
  demand.checkpoint_file = 0.5 * demand.fields;
  return demand;
}

std::optional<Pace> pace_of(const Scene& scene, double seconds)
{
  // More are not laid out and begun within the time.
  constexpr double most_particles = 150'000;
  constexpr double most_bytes = 3e8;
  constexpr int greatest_factor = 32;
  // Less of a run tells less than a coarser one that was complete.
  constexpr double least_part = 0.1;
  const int dimension = scene.grid.dimension;
  const std::vector<std::size_t> n = particles_of_materials(scene);
  const double n_particles = static_cast<double>(std::accumulate(n.begin(), n.end(), std::size_t{0}));
  const double end = processor_seconds() + seconds;
  std::vector<Trial> complete;
  std::optional<Trial> trial;
  for (int factor = greatest_factor; factor >= 1 && !(trial && !trial->complete()); --factor) {
    const double left = end - processor_seconds();
    if (n_particles / portable::pow(factor, dimension) > most_particles || left <= 0) break;
    const auto coarse = coarsened(scene, factor);
    if (!coarse || demand_of(*coarse).fields > most_bytes) continue;
    try {
      trial = tried(*coarse, factor, left);
    } catch (const std::exception&) {
      continue;  // too coarse for something; what is wrong with the scene itself shows in its run
    }
    if (trial && trial->complete()) complete.push_back(*trial);
  }
  if (trial && !trial->complete() && (complete.empty() || trial->end().part >= least_part)) {
    return extrapolated(*trial, complete.empty() ? nullptr : &complete.back(), dimension);
  }
  if (complete.empty()) return std::nullopt;
  return extrapolated(complete.back(), complete.size() == 1 ? nullptr : &complete[complete.size() - 2], dimension);
}

}  // namespace tamp::tasks
