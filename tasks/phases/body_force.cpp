#include <algorithm>
#include <vector>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeSums;
using runtime::TaskContext;

namespace
{

/// On each of a patch's particles of one material [N], from the function of the body that it was made for; zero where
/// that has none.
template <int D>
std::vector<Vector<D>> body_forces_on(const Scene& scene, double time, std::span<const std::int64_t> body,
                                      std::span<const double> mass, std::span<const Vector<D>> reference)
{
  std::vector<Vector<D>> forces(mass.size(), Vector<D>::Zero());
  for (std::size_t p = 0; p < mass.size(); ++p) {
    const auto& of_body = scene.bodies[static_cast<std::size_t>(body[p])].functions.body_force;
    if (of_body) forces[p] = mass[p] * of_body(in_space<D>(reference[p]), time).template head<D>();
  }
  return forces;
}

/// Materials of which some body has one.
std::vector<int> materials_with_body_force(const Scene& scene)
{
  std::vector<int> materials;
  for (const SceneBody& body : scene.bodies) {
    const bool is_new = std::find(materials.begin(), materials.end(), body.material) == materials.end();
    if (body.functions.body_force && is_new) materials.push_back(body.material);
  }
  return materials;
}

}  // namespace

/// As of the start of the step, like the stress. The image behind a wall feels the image of the force.
template <int D>
runtime::TaskList body_force(const Method<D>& method)
{
  if (!method.scene.has_body_force()) return {};
  return {runtime::task("body force")
              .over_patches_and_groups()
              .sparse()
              .reads(particle::body.previous(), particle::mass.previous(), particle::reference_position<D>.previous(),
                     particle::position<D>.previous(), particle::deformation_gradient<D>.previous())
              .accumulates(node::sums<D>.halo(method.halo))
              .body([&method, materials = materials_with_body_force(method.scene)](const TaskContext& at, auto data) {
                const auto sums = data[node::sums<D>];
                if (std::find(materials.begin(), materials.end(), at.group) == materials.end()) return;
                const auto forces = body_forces_on<D>(method.scene, at.step.time, data[particle::body.previous()],
                                                      data[particle::mass.previous()],
                                                      data[particle::reference_position<D>.previous()]);
                // Sums of other phases at the nodes have their images already.
                std::vector<NodeSums<D>> own(static_cast<std::size_t>(sums.box().size()));
                method.interpolation(at.group).add_forces(block_of<D>(at.layout, sums), places_at_start<D>(data),
                                                          std::span(forces), own.data());
                for_each_wall(method, at, sums.box(), [&](const Wall<D>& wall) {
                  wall.keeps_normal_push() ? wall.image.add_image(own.data()) : wall.image.fold(own.data());
                });
                for (std::size_t i = 0; i < own.size(); ++i) sums.data()[i].add_force(own[i].internal_force());
              })};
}

/// Over the way that particles go, as gravity's is counted: half of it by the forces of the start of the step and half
/// by those of its end, which are those that kick the nodes before and after.
template <int D>
runtime::TaskList work_of_body_force(const Method<D>& method)
{
  if (!method.scene.has_body_force()) return {};
  return {runtime::task("work of body force")
              .over_patches_and_groups(materials_with_body_force(method.scene))
              .sparse()
              .reads(particle::body.previous(), particle::mass.previous(), particle::reference_position<D>.previous(),
                     particle::position<D>.previous(), particle::position<D>)
              .reduces(body_force_work)
              .body([&method](const TaskContext& at, auto data) {
                const auto before = data[particle::position<D>.previous()];
                const auto after = data[particle::position<D>];
                const auto forces_at = [&](double time) {
                  return body_forces_on<D>(method.scene, time, data[particle::body.previous()],
                                           data[particle::mass.previous()],
                                           data[particle::reference_position<D>.previous()]);
                };
                const auto at_start = forces_at(at.step.time), at_end = forces_at(at.step.time + at.step.size);
                BodyForceWork& work = data[body_force_work];
                for (std::size_t p = 0; p < at_start.size(); ++p) {
                  const Vector<D> half_way = 0.5 * (after[p] - before[p]);
                  work.value += (at_start[p] + at_end[p]).dot(half_way);
                  work.at_end += at_end[p].dot(half_way);
                }
              })};
}

template runtime::TaskList body_force(const Method<2>&);
template runtime::TaskList body_force(const Method<3>&);
template runtime::TaskList work_of_body_force(const Method<2>&);
template runtime::TaskList work_of_body_force(const Method<3>&);

}  // namespace tamp::tasks
