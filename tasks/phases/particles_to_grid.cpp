#include <string>
#include <utility>
#include <vector>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// Sums over particles at the nodes, of some materials, or of all if none are given: with the stress of one end of the
/// step, or, where they share that, with what their cells have made of it.
template <int D>
runtime::TaskDeclaration gather(const Method<D>& method, const std::string& name, std::vector<int> materials,
                                runtime::StepEnd end, bool shares_stress)
{
  return runtime::task(name)
      .over_patches_and_groups(std::move(materials))
      .sparse()
      .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
             particle::velocity<D>.previous(), particle::mass.previous(), particle::volume.at(end),
             particle::stress<D>.at(end).when(!shares_stress), particle::shared_stress<D>.when(shares_stress),
             particle::viscous_pressure.at(end),
             particle::velocity_gradient<D>.at(runtime::StepEnd::start).when(method.brings_gradients()),
             particle::velocity_moment<D>.at(runtime::StepEnd::start).when(method.brings_moments()))
      .accumulates(node::sums<D>.halo(method.halo))
      .body([&method, shares_stress](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const bool is_rigid = method.rigid_body(at.group) != nullptr;
        const components::ParticleSources<D> sources{
            .places = places_at_start<D>(data),
            .velocity = data[particle::velocity<D>.previous()],
            .mass = data[particle::mass.previous()],
            .volume = data[particle::volume],
            .stress = shares_stress ? data[particle::shared_stress<D>] : data[particle::stress<D>],
            .viscous_pressure = data[particle::viscous_pressure],
            .carried_gradient = is_rigid ? components::CarriedGradient::none : method.carried_gradient,
            .carried = carried_by<D>(data)};
        method.interpolation(at.group).particles_to_grid(block_of<D>(at.layout, sums), sources,
                                                         method.needs_surface_of(at.group), sums.data());
        fold(method, at, sums);
      });
}

}  // namespace

/// The stress of rigid bodies is never new.
template <int D>
runtime::TaskList particles_to_grid(const Method<D>& method)
{
  using runtime::StepEnd;
  const StepEnd end = method.stress_timing == StressTiming::usf ? StepEnd::end : StepEnd::start;
  const bool shares = method.deforms_as_cells();
  const bool is_new = end == StepEnd::end || shares;
  if (!is_new || method.deformable_materials.empty()) {
    return {gather(method, "particles to grid", {}, StepEnd::start, false)};
  }
  runtime::TaskList tasks{gather(method, "particles to grid", method.deformable_materials, end, shares)};
  const std::vector<int> rigid = method.rigid_materials();
  if (!rigid.empty()) tasks.push_back(gather(method, "rigid particles to grid", rigid, StepEnd::start, false));
  return tasks;
}

template runtime::TaskList particles_to_grid(const Method<2>&);
template runtime::TaskList particles_to_grid(const Method<3>&);

}  // namespace tamp::tasks
