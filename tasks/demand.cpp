#include "tasks/demand.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <numeric>
#include <string>
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
  }
  return coarse;
}

/// Of a run to the end, from one that came to a part of it.
struct Trial {
  Pace pace;
  bool complete = false;
};

/// Runs a scene as far as it comes in the time; nothing if it has not all the bodies.
std::optional<Trial> tried(const Scene& scene, double seconds)
{
  using Clock = std::chrono::steady_clock;
  const auto simulation = Simulation::make(scene, 1);
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    if (simulation->n_particles(static_cast<int>(m)) == 0) return std::nullopt;
  }
  simulation->record(false);
  const auto start = Clock::now();
  const auto elapsed = [&] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  while (simulation->time() < scene.time.end && elapsed() < seconds) simulation->advance(scene.time.end);
  const double part = simulation->time() / scene.time.end;
  return Trial{{static_cast<double>(simulation->n_steps()) / part, elapsed() / part}, part == 1};
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
  demand.checkpoint_file = 0.5 * demand.fields;
  return demand;
}

std::optional<Pace> pace_of(const Scene& scene, double seconds)
{
  using Clock = std::chrono::steady_clock;
  // More are not laid out and begun within the time.
  constexpr double most_particles = 50'000;
  constexpr int greatest_factor = 32;
  const std::vector<std::size_t> n = particles_of_materials(scene);
  const double n_particles = static_cast<double>(std::accumulate(n.begin(), n.end(), std::size_t{0}));
  const auto end = Clock::now() + std::chrono::duration<double>(seconds);
  std::optional<Pace> pace;
  // From coarse to fine: the finest that comes to its end counts, or else the first that does not.
  for (int factor = greatest_factor; factor >= 1; --factor) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    if (n_particles / portable::pow(factor, scene.grid.dimension) > most_particles || left <= 0) break;
    const auto coarse = coarsened(scene, factor);
    if (!coarse) continue;
    std::optional<Trial> trial;
    try {
      trial = tried(*coarse, left);
    } catch (const std::exception&) {
      continue;  // too coarse for something; what is wrong with the scene itself shows in its run
    }
    if (!trial || (pace && !trial->complete)) continue;
    const double finer_work = portable::pow(factor, scene.grid.dimension + 1);
    pace = Pace{trial->pace.n_steps * factor, trial->pace.core_seconds * finer_work};
    if (!trial->complete) break;
  }
  return pace;
}

}  // namespace tamp::tasks
