#include <algorithm>
#include <array>
#include <span>
#include <vector>

#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"

namespace tamp::tasks
{

using runtime::Index;
using runtime::TaskContext;

namespace
{

/// The force on particle p of a patch and material [N], from the function of the body that it was made for; zero where
/// that has none.
template <int D, class Data>
Vector<D> body_force_on(std::size_t p, const Scene& scene, double time, const Data& data)
{
  const auto body = static_cast<std::size_t>(data[particle::body.previous()][p]);
  const auto& of_body = scene.bodies[body].functions.body_force;
  if (!of_body) return Vector<D>::Zero();
  const Vector<D>& reference = data[particle::reference_position<D>.previous()][p];
  return data[particle::mass.previous()][p] * of_body(in_space<D>(reference), time).template head<D>();
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

template <int D>
runtime::TaskDeclaration gather_body_force(const Method<D>& method)
{
  return runtime::task("gather body force")
      .over_patches_and_groups(materials_with_body_force(method.scene))
      .sparse()
      .reads(particle::body.previous(), particle::mass.previous(), particle::reference_position<D>.previous(),
             particle::position<D>.previous(), particle::deformation_gradient<D>.previous())
      .accumulates(node::body_force<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto places = places_at_start<D>(data);
        const auto sums = data[node::body_force<D>];
        std::array<Vector<D>, motion_batch> buffer;
        for (std::size_t first = 0; first < places.size(); first += motion_batch) {
          const auto batch = places.subspan(first, std::min(motion_batch, places.size() - first));
          const auto forces = std::span(buffer).first(batch.size());
          for (std::size_t p = 0; p < forces.size(); ++p) {
            forces[p] = body_force_on<D>(first + p, method.scene, at.step.time, data);
          }
          method.interpolation(at.group).add_vectors(block_of<D>(at.layout, sums), batch, forces, sums.data());
        }
        fold_images(method, at, sums, false);
      });
}

template <int D>
runtime::TaskDeclaration push_nodes(const Method<D>& method)
{
  return runtime::task("push nodes")
      .over_patches_and_groups(materials_with_body_force(method.scene))
      .sparse()
      .reads(node::body_force<D>.halo(method.halo))
      .updates(node::sums<D>.halo(method.halo))
      .body([](const TaskContext&, auto data) {
        const auto force = data[node::body_force<D>];
        const auto sums = data[node::sums<D>];
        for_each(sums.box(), [&](const Index& i) { sums[i].add_force(force[i].value()); });
      });
}

}  // namespace

/// As of the start of the step, like the stress. The image behind a wall feels the image of the force.
template <int D>
runtime::TaskList body_force(const Method<D>& method)
{
  if (!method.scene.has_body_force()) return {};
  return {gather_body_force(method), push_nodes(method)};
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
                BodyForceWork& work = data[body_force_work];
                for (std::size_t p = 0; p < after.size(); ++p) {
                  const Vector<D> half_way = 0.5 * (after[p] - before[p]);
                  const Vector<D> at_start = body_force_on<D>(p, method.scene, at.step.time, data),
                                  at_end = body_force_on<D>(p, method.scene, at.step.time + at.step.size, data);
                  work.value += (at_start + at_end).dot(half_way);
                  work.at_end += at_end.dot(half_way);
                }
              })};
}

template runtime::TaskList body_force(const Method<2>&);
template runtime::TaskList body_force(const Method<3>&);
template runtime::TaskList work_of_body_force(const Method<2>&);
template runtime::TaskList work_of_body_force(const Method<3>&);

}  // namespace tamp::tasks
