#include "tasks/step_graph.hpp"

#include "runtime/grid/curve_order.hpp"
#include "runtime/ranks/deal_patches.hpp"
#include "tasks/set_up/fill_bodies.hpp"
#include "tasks/time_step.hpp"

namespace tamp::tasks
{

namespace
{

template <int D>
runtime::PatchLayout layout_on_ranks(const Scene& scene, int n_ranks)
{
  const BodyParticles<D> particles(scene, runtime::PatchLayout(scene.grid, scene.n_patches));
  return dealt(scene, particles.counts(), n_ranks);
}

/// The bodies know the method, which ends here.
template <int D>
runtime::TaskGraph without_bodies(const Scene& scene, const runtime::PatchLayout& layout)
{
  const Method<D> method(scene);
  runtime::TaskList step = time_step(method);
  for (runtime::TaskDeclaration& task : step) task.body = nullptr;
  return {std::move(step), layout, material_names(scene), host_data(method)};
}

}  // namespace

runtime::PatchLayout dealt(const Scene& scene, const std::vector<std::size_t>& n_particles, int n_ranks)
{
  runtime::PatchLayout layout(scene.grid, scene.n_patches);
  std::vector<double> particles_per_patch(static_cast<std::size_t>(layout.size()), 0);
  for (std::size_t k = 0; k < n_particles.size(); ++k) {
    particles_per_patch[k / scene.materials.size()] += static_cast<double>(n_particles[k]);
  }
  const std::vector<int> order = runtime::curve_order(scene.n_patches);
  layout.give_to_ranks(runtime::deal_patches(order, particles_per_patch, n_ranks), n_ranks);
  return layout;
}

std::vector<std::string> material_names(const Scene& scene)
{
  std::vector<std::string> names;
  for (const SceneMaterial& m : scene.materials) names.push_back(m.name);
  return names;
}

StepGraph::StepGraph(const Scene& scene, int n_ranks)
    : layout_(scene.grid.dimension == 2 ? layout_on_ranks<2>(scene, n_ranks) : layout_on_ranks<3>(scene, n_ranks)),
      graph_(scene.grid.dimension == 2 ? without_bodies<2>(scene, layout_) : without_bodies<3>(scene, layout_))
{
}

}  // namespace tamp::tasks
