#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "components/loads/pressed_particles.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeSums;
using components::PressureSums;
using runtime::Index;
using runtime::TaskContext;

namespace
{

/// The pressure loads of a material's bodies in one step, as their particles bring them to the grid. Particles of a
/// body stand together, so that its load is found once for many of them.
template <int D>
class Pressures
{
 public:
  Pressures(const Method<D>& method, int material, double time)
      : bodies_(method.scene.bodies),
        time_(time),
        size_(method.cell_size / method.scene.particles_per_axis_of(material)),
        depth_(method.scene.pressed_depth(material))
  {
  }

  /// The pressure on a particle that started at `reference`, that of the scene and that of the problem [Pa].
  components::ByFace<D> at(std::int64_t body, const Vector<D>& reference)
  {
    if (body != body_) take(body);
    components::ByFace<D> pressure = pressure_ * box_.part_of(reference, size_, depth_);
    const auto& of_problem = bodies_[static_cast<std::size_t>(body)].functions.pressure;
    if (!of_problem) return pressure;
    return pressure.array() + of_problem(in_space<D>(reference), time_);
  }

 private:
  void take(std::int64_t body)
  {
    const auto& load = bodies_[static_cast<std::size_t>(body)].pressure;
    body_ = body;
    pressure_ = load.has_value() ? load->curve.at(time_) : 0;
    box_ = load.has_value() ? load->template box_of<D>() : components::PressedBox<D>{};
  }

  const std::vector<SceneBody>& bodies_;
  double time_;
  double size_;
  double depth_;
  std::int64_t body_ = -1;
  double pressure_ = 0;
  components::PressedBox<D> box_;
};

/// Gathers the pressure on nodes, weighted by the mass of their particles.
template <int D>
runtime::TaskDeclaration gather_pressure(const Method<D>& method)
{
  return runtime::task("gather pressure")
      .over_patches_and_groups(method.pressed_materials)
      .sparse()
      .reads(particle::body.previous(), particle::reference_position<D>.previous(), particle::position<D>.previous(),
             particle::deformation_gradient<D>.previous(), particle::mass.previous())
      .accumulates(node::pressure_sums<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto body = data[particle::body.previous()];
        const auto reference = data[particle::reference_position<D>.previous()];
        const auto mass = data[particle::mass.previous()];
        const auto sums = data[node::pressure_sums<D>];
        Pressures<D> pressures(method, at.group, at.step.time);
        const auto places = places_at_start<D>(data);
        std::array<components::ByFace<D>, motion_batch> buffer;
        for (std::size_t first = 0; first < places.size(); first += motion_batch) {
          const auto batch = places.subspan(first, std::min(motion_batch, places.size() - first));
          const auto pressure = std::span(buffer).first(batch.size());
          for (std::size_t p = 0; p < pressure.size(); ++p) {
            pressure[p] = mass[first + p] * pressures.at(body[first + p], reference[first + p]);
          }
          components::add_pressure<D>(method.interpolation(at.group), block_of<D>(at.layout, sums), batch, pressure,
                                      sums.data());
        }
        for_each_wall(method, at, sums.box(), [&](const Wall<D>& wall) { wall.image.add_image(sums.data()); });
      });
}

template <int D>
runtime::TaskDeclaration press_nodes(const Method<D>& method)
{
  return runtime::task("press nodes")
      .over_patches_and_groups(method.pressed_materials)
      .sparse()
      .reads(node::pressure_sums<D>.halo(method.halo))
      .updates(node::sums<D>.halo(method.halo))
      .body([](const TaskContext&, auto data) {
        const auto pressure = data[node::pressure_sums<D>];
        const auto sums = data[node::sums<D>];
        for_each(sums.box(), [&](const Index& i) {
          NodeSums<D>& node = sums[i];
          node.add_force(components::pressure_force(pressure[i], node.mass(), node.surface_gradient()));
        });
      });
}

}  // namespace

/// The surface is where the surface gradient of the whole material says it is, so that neither a mirror nor another
/// body of the same material counts as one.
template <int D>
runtime::TaskList press(const Method<D>& method)
{
  if (method.pressed_materials.empty()) return {};
  return {gather_pressure(method), press_nodes(method)};
}

/// Work goes with the mean of the velocities before and after the step, as the energies of leapfrog are counted.
template <int D>
runtime::TaskList account_for_pressure(const Method<D>& method)
{
  if (method.pressed_materials.empty()) return {};
  return {runtime::task("account for pressure")
              .over_patches_and_groups(method.pressed_materials)
              .sparse()
              .reads(node::pressure_sums<D>.halo(method.halo), node::sums<D>.halo(method.halo),
                     node::motion<D>.halo(method.halo))
              .reduces(load_totals)
              .body([&method](const TaskContext& at, auto data) {
                const auto pressure = data[node::pressure_sums<D>];
                const auto sums = data[node::sums<D>];
                const auto motion = data[node::motion<D>];
                LoadTotals& totals = data[load_totals];
                auto& given = totals.impulse[static_cast<std::size_t>(at.group)];
                const double kick = 0.5 * (at.step.previous_size + at.step.size);
                const double half_step_before = 0.5 * at.step.previous_size;
                for_each(counted_nodes(method, at), [&](const Index& i) {
                  const double mass = sums[i].mass();
                  if (!(mass > method.least_node_mass)) return;
                  const Vector<D> change =
                      kick / mass * components::pressure_force(pressure[i], mass, sums[i].surface_gradient());
                  const Vector<D> at_start = sums[i].momentum() / mass;
                  totals.work += 0.5 * mass * change.dot(at_start + motion[i].velocity());
                  totals.work_at_start += half_step_before / kick * mass * change.dot(at_start);
                  for (std::size_t k = 0; k < std::size_t{D}; ++k) {
                    given[k] += own_mass(method, at, sums, i, k) * change[static_cast<int>(k)];
                  }
                });
              })};
}

template runtime::TaskList press(const Method<2>&);
template runtime::TaskList press(const Method<3>&);
template runtime::TaskList account_for_pressure(const Method<2>&);
template runtime::TaskList account_for_pressure(const Method<3>&);

}  // namespace tamp::tasks
