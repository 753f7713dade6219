#include <string>
#include <utility>
#include <vector>

#include "tasks/labels.hpp"
#include "tasks/phases/bring_gradients.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// The stress by which particles push on nodes.
template <int D, class Data>
std::span<const SymmetricTensor<D>> stress_on_nodes(const Data& data)
{
  if constexpr (Data::has(particle::shared_stress<D>)) {
    return data[particle::shared_stress<D>];
  } else {
    return newest(data, particle::stress<D>);
  }
}

/// The task with what it gathers; it reads volume, stress and viscous pressure already, of the start of the step or as
/// this step has made them.
template <int D, class Task>
runtime::TaskDeclaration gathering(const Method<D>& method, Task task)
{
  auto whole = std::move(task)
                   .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
                          particle::velocity<D>.previous(), particle::mass.previous())
                   .accumulates(node::sums<D>.halo(method.halo));
  return with_gradients(method, std::move(whole), [&method](const TaskContext& at, auto data) {
    const auto sums = data[node::sums<D>];
    const auto block = block_of<D>(at.layout, sums);
    const components::Interpolation<D>& interpolation = method.interpolation(at.group);
    const components::ParticleSources<D> sources{.places = places_at_start<D>(data),
                                                 .velocity = data[particle::velocity<D>.previous()],
                                                 .mass = data[particle::mass.previous()],
                                                 .volume = newest(data, particle::volume),
                                                 .stress = stress_on_nodes<D>(data),
                                                 .viscous_pressure = newest(data, particle::viscous_pressure)};
    interpolation.particles_to_grid(block, sources, method.needs_surface_of(at.group), sums.data());
    if (method.rigid_body(at.group) == nullptr) bring_gradients<D>(interpolation, block, data, sums.data());
    for_each_wall(method, at, sums.box(), [&](const Wall<D>& wall) { fold(wall, at, sums); });
  });
}

/// Of the materials given, all if none are.
template <int D>
runtime::TaskDeclaration gather_at_start(const Method<D>& method, const std::string& name, std::vector<int> materials)
{
  return gathering(method, runtime::task(name)
                               .over_patches_and_groups(std::move(materials))
                               .sparse()
                               .reads(particle::volume.previous(), particle::stress<D>.previous(),
                                      particle::viscous_pressure.previous()));
}

/// Of the deformable materials, whose stress this step has made or shared.
template <int D>
runtime::TaskDeclaration gather_new_stress(const Method<D>& method)
{
  auto task = runtime::task("particles to grid").over_patches_and_groups(method.deformable_materials).sparse();
  if (method.stress_timing != StressTiming::usf) {
    return gathering(method, std::move(task).reads(particle::volume.previous(), particle::viscous_pressure.previous(),
                                                   particle::shared_stress<D>));
  }
  auto updated = std::move(task).reads(particle::volume, particle::viscous_pressure);
  return method.deforms_as_cells() ? gathering(method, std::move(updated).reads(particle::shared_stress<D>))
                                   : gathering(method, std::move(updated).reads(particle::stress<D>));
}

}  // namespace

/// The stress of rigid bodies is never new.
template <int D>
std::vector<runtime::TaskDeclaration> particles_to_grid(const Method<D>& method)
{
  const bool is_new = method.stress_timing == StressTiming::usf || method.deforms_as_cells();
  if (!is_new || method.deformable_materials.empty()) return {gather_at_start(method, "particles to grid", {})};
  std::vector<runtime::TaskDeclaration> phases{gather_new_stress(method)};
  std::vector<int> rigid;
  for (const RigidBody& body : method.rigid_bodies) rigid.push_back(body.material);
  if (!rigid.empty()) phases.push_back(gather_at_start(method, "rigid particles to grid", rigid));
  return phases;
}

template std::vector<runtime::TaskDeclaration> particles_to_grid(const Method<2>&);
template std::vector<runtime::TaskDeclaration> particles_to_grid(const Method<3>&);

}  // namespace tamp::tasks
