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

/// The task with what it gathers; it reads volume, stress and viscous pressure already, of the start of the step or as
/// this step has made them.
template <int D, class Task>
runtime::TaskDeclaration gathering(const Method<D>& method, Task task)
{
  auto whole = std::move(task).accumulates(node::sums<D>.halo(method.halo));
  return with_gradients(method, std::move(whole), [&method](const TaskContext& at, auto data) {
    const auto sums = data[node::sums<D>];
    const auto block = block_of<D>(at.layout, sums);
    const components::Interpolation<D>& interpolation = method.interpolation(at.group);
    const components::ParticleSources<D> sources{.places = places_at_start<D>(data),
                                                 .velocity = data[particle::velocity<D>.previous()],
                                                 .mass = data[particle::mass.previous()],
                                                 .volume = newest(data, particle::volume),
                                                 .stress = newest(data, particle::stress<D>),
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
  return gathering(method,
                   runtime::task(name)
                       .over_patches_and_groups(std::move(materials))
                       .sparse()
                       .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
                              particle::velocity<D>.previous(), particle::mass.previous(), particle::volume.previous(),
                              particle::stress<D>.previous(), particle::viscous_pressure.previous()));
}

template <int D>
runtime::TaskDeclaration gather_updated(const Method<D>& method)
{
  return gathering(method, runtime::task("particles to grid")
                               .over_patches_and_groups(method.deformable_materials)
                               .sparse()
                               .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
                                      particle::velocity<D>.previous(), particle::mass.previous(), particle::volume,
                                      particle::stress<D>, particle::viscous_pressure));
}

}  // namespace

/// Where stress comes first, that of rigid bodies does not.
template <int D>
std::vector<runtime::TaskDeclaration> particles_to_grid(const Method<D>& method)
{
  if (method.stress_timing != StressTiming::usf || method.deformable_materials.empty()) {
    return {gather_at_start(method, "particles to grid", {})};
  }
  std::vector<runtime::TaskDeclaration> phases{gather_updated(method)};
  std::vector<int> rigid;
  for (const RigidBody& body : method.rigid_bodies) rigid.push_back(body.material);
  if (!rigid.empty()) phases.push_back(gather_at_start(method, "rigid particles to grid", rigid));
  return phases;
}

template std::vector<runtime::TaskDeclaration> particles_to_grid(const Method<2>&);
template std::vector<runtime::TaskDeclaration> particles_to_grid(const Method<3>&);

}  // namespace tamp::tasks
