#include "tools/bench/peers.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>

#include "tools/bench/bench.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/shipped_inputs.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

/// A program and method in the contest.
struct Contestant {
  std::string name;
  std::size_t n_particles;
  std::function<void()> step;
  /// Time of a particle and step [ns], by round.
  std::vector<double> ns{};

  void run(int n_steps)
  {
    const double start = process_seconds();
    for (int i = 0; i < n_steps; ++i) step();
    ns.push_back((process_seconds() - start) / (static_cast<double>(n_particles) * n_steps) * 1e9);
  }
};

/// Assignments that make the block of a scene a cube of about so many particles, with the same cells.
std::vector<std::string> cube_of(const tasks::Scene& scene, double n_particles)
{
  const int D = scene.grid.dimension;
  const double n = std::round(std::pow(n_particles, 1.0 / D) / scene.particles_per_axis);
  const double edge = n * scene.grid.cell_size, margin = 4 * scene.grid.cell_size;
  std::vector<double> grid(static_cast<std::size_t>(D), edge + 2 * margin), lower(grid.size(), margin),
      upper(grid.size(), edge + margin);
  grid.back() = edge + margin;
  lower.back() = 0;
  upper.back() = edge;
  return {fmt::format("/grid/upper=[{}]", fmt::join(grid, ",")),
          fmt::format("/bodies/block/geometry/lower=[{}]", fmt::join(lower, ",")),
          fmt::format("/bodies/block/geometry/upper=[{}]", fmt::join(upper, ","))};
}

std::unique_ptr<tasks::Simulation> block_with(const std::string& file, const std::string& transfer,
                                              const PeerOptions& options)
{
  const std::filesystem::path path = shipped_input(file);
  std::vector<std::string> assignments;
  if (options.n_particles > 0) assignments = cube_of(read_scene(path).scene, static_cast<double>(options.n_particles));
  assignments.push_back("/transfer=" + transfer);
  return tasks::Simulation::make(read_scene(path, assignments).scene, 1);
}

Contestant tamp_with(const std::string& file, const std::string& transfer, const PeerOptions& options)
{
  const std::shared_ptr<tasks::Simulation> simulation = block_with(file, transfer, options);
  return {"tamp, " + transfer, simulation->n_particles(0),
          [simulation] { simulation->advance(simulation->scene().time.end); }};
}

template <int D>
Contestant plain_with(const std::string& file, const PeerOptions& options)
{
  const auto simulation = block_with(file, "apic", options);
  const auto plain = std::make_shared<PlainMlsMpm<D>>(plain_of<D>(*simulation));
  return {"plain MLS-MPM", simulation->n_particles(0),
          [plain, step_size = simulation->scene().time.maximum_step] { plain->step(step_size); }};
}

/// Rows of the table, of the plain program first.
void compare(std::vector<Contestant> contestants, int dimension, const PeerOptions& options, Result& result)
{
  for (Contestant& contestant : contestants) contestant.step();
  for (int round = 0; round < options.n_rounds; ++round) {
    for (Contestant& contestant : contestants) contestant.run(options.n_steps);
  }
  const double plain_ns = median(contestants.front().ns);
  for (const Contestant& contestant : contestants) {
    const Quartiles ns = quartiles(contestant.ns);
    result.json.push_back({{"dimension", dimension},
                           {"program", contestant.name},
                           {"particles", contestant.n_particles},
                           {"ns_per_particle_step", ns.median},
                           {"of_plain", ns.median / plain_ns}});
    result.text += fmt::format("  {:<11}{:<15}{:>9}{:>16.1f}{:>14.1f}{:>10.2f}\n", dimension, contestant.name,
                               contestant.n_particles, ns.median, ns.upper - ns.lower, ns.median / plain_ns);
  }
}

}  // namespace

template <int D>
PlainMlsMpm<D> plain_of(tasks::Simulation& simulation)
{
  using Particle = PlainParticle<D>;
  const tasks::Scene& scene = simulation.scene();
  typename PlainMlsMpm<D>::Problem problem{};
  problem.cell_size = scene.grid.cell_size;
  std::copy_n(scene.grid.n_cells.begin(), D, problem.n_cells.begin());
  problem.soil = std::get<components::DruckerPrager>(scene.materials.front().model);
  problem.gravity = -scene.gravity[D - 1];

  const double volume = std::pow(scene.grid.cell_size / scene.particles_per_axis, D);
  const runtime::ParticleBlock block = simulation.particle_columns().front();
  const auto numbers = [&](const char* name) {
    return std::get<std::span<const double>>(std::ranges::find(block.columns, name, &runtime::Column::name)->values);
  };
  const auto position = numbers("position"), velocity = numbers("velocity");
  std::vector<Particle> particles(block.n);
  for (std::size_t p = 0; p < block.n; ++p) {
    Particle& particle = particles[p];
    particle.mass = scene.materials.front().density * volume;
    particle.initial_volume = particle.volume = volume;
    for (std::size_t k = 0; k < D; ++k) {
      particle.position[k] = position[p * D + k] - scene.grid.lower[k];
      particle.velocity[k] = velocity[p * D + k];
      particle.deformation_gradient[k][k] = 1;
    }
  }
  return PlainMlsMpm<D>(problem, std::move(particles));
}
template PlainMlsMpm<2> plain_of(tasks::Simulation& simulation);
template PlainMlsMpm<3> plain_of(tasks::Simulation& simulation);

Result peers(const PeerOptions& options)
{
  Result result;
  result.json = nlohmann::ordered_json::array();
  result.text = fmt::format(
      "peers: a block on a floor, {} rounds of {} steps in turns, one thread; processor time a particle and step\n"
      "  {:<11}{:<15}{:>9}{:>16}{:>14}{:>10}\n",
      options.n_rounds, options.n_steps, "dimensions", "program", "particles", "median [ns]", "quartiles", "of plain");
  compare({plain_with<2>("peers/block.json", options), tamp_with("peers/block.json", "flip", options),
           tamp_with("peers/block.json", "apic", options)},
          2, options, result);
  compare({plain_with<3>("peers/block_3d.json", options), tamp_with("peers/block_3d.json", "flip", options),
           tamp_with("peers/block_3d.json", "apic", options)},
          3, options, result);
  return result;
}

}  // namespace tamp::tools::bench
