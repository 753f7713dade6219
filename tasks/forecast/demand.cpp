#include "tasks/forecast/demand.hpp"

#include <algorithm>
#include <set>
#include <span>
#include <utility>
#include <vector>

#include "runtime/data/heap.hpp"
#include "runtime/warehouse/storage_forecast.hpp"
#include "tasks/graphs.hpp"
#include "tasks/report/field_columns.hpp"
#include "tasks/set_up/fill_bodies.hpp"
#include "tasks/step_graph.hpp"

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

/// Numbers that a particle has in an output file.
std::size_t n_output_numbers(const Scene& scene, int material)
{
  std::size_t n = 1;  // id
  for (const FieldName& field : particle_field_names(scene, material)) {
    if (scene.output.fields.has(field.name) || is_always_written(field.name)) n += runtime::n_in_file(field.kind);
  }
  return n;
}

/// Numbers of a node in an output.
std::size_t n_output_numbers(const FieldChoice& choice)
{
  std::size_t n = 0;
  for (const FieldName& field : node_field_names()) {
    if (choice.has(field.name)) n += runtime::n_in_file(field.kind);
  }
  return n;
}

/// Bytes of a copy of the particles' state, which is larger than any other.
double state_bytes(std::span<const runtime::TaskGraph* const> graphs, const std::vector<std::size_t>& n_particles)
{
  std::set<std::pair<const runtime::Label*, int>> state;
  for (const runtime::TaskGraph* graph : graphs) {
    for (const runtime::LabelUse& use : graph->label_uses()) {
      if (use.state && use.label->centring() == runtime::Centring::particle) state.emplace(use.label, use.group);
    }
  }
  double bytes = 0;
  for (const auto& [label, group] : state) {
    bytes += static_cast<double>(label->value_bytes() * n_particles[static_cast<std::size_t>(group)]);
  }
  return bytes;
}

/// Memory of tasks over that of the compiled graph alone: the part that each rank has of all tasks, with their labels
/// and their schedule, and the part that it has only of its own, such as their data. The sum is measured on one rank
/// with 400 to 10,000 patches; how it divides is an estimate.
constexpr double of_all_tasks = 3.5;
constexpr double of_own_tasks = 5;

/// The memory of fields, of the graphs, and of a copy of the state.
template <int D>
void add_fields(const Scene& scene, const std::vector<std::size_t>& n_particles, int n_ranks, Demand& demand)
{
  const Method<D> method(scene);
  const std::vector<std::size_t> counts =
      BodyParticles<D>(scene, runtime::PatchLayout(scene.grid, scene.n_patches)).counts();
  const runtime::PatchLayout layout = dealt(scene, counts, n_ranks);
  const auto heap_before = static_cast<double>(runtime::heap_bytes());
  const runtime::CompiledGraphs compiled(layout, material_names(scene), graphs_of(method));
  const double compiled_bytes = std::max(0.0, static_cast<double>(runtime::heap_bytes()) - heap_before);
  demand.graph = (n_ranks * of_all_tasks + of_own_tasks) * compiled_bytes;
  const std::vector<const runtime::TaskGraph*> pointers = compiled.pointers();
  for (const runtime::TaskGraph* graph : pointers) {
    for (const runtime::Message& message : graph->messages()) demand.graph += 2 * static_cast<double>(message.bytes);
  }
  demand.fields = runtime::forecast_bytes(pointers, counts, n_ranks);
  demand.checkpoint_file = state_bytes(pointers, n_particles);
}

}  // namespace

Demand demand_of(const Scene& scene, int n_ranks)
{
  const std::vector<std::size_t> n_particles = particles_of_materials(scene);
  Demand demand;
  double n_nodes = 1;
  for (int k = 0; k < scene.grid.dimension; ++k) n_nodes *= scene.grid.n_cells[static_cast<std::size_t>(k)] + 1;
  constexpr double bytes_of_number = 8;
  demand.output_file = bytes_of_number * static_cast<double>(n_output_numbers(scene.output.fields)) * n_nodes;
  for (std::size_t m = 0; m < n_particles.size(); ++m) {
    demand.n_particles += n_particles[m];
    demand.output_file +=
        bytes_of_number * static_cast<double>(n_output_numbers(scene, static_cast<int>(m)) * n_particles[m]);
  }
  const auto add = scene.grid.dimension == 2 ? add_fields<2> : add_fields<3>;
  add(scene, n_particles, n_ranks, demand);
  // One column at a time is also held in the form that it has in the file.
  constexpr double most_components = 6;
  const auto most_particles = static_cast<double>(*std::max_element(n_particles.begin(), n_particles.end()));
  demand.output_room = demand.output_file + bytes_of_number * most_components * most_particles;
  return demand;
}

}  // namespace tamp::tasks
