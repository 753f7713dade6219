#include <array>
#include <limits>

#include "components/contact/friction.hpp"
#include "components/loads/time_step.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/contact_nodes.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using runtime::GridView;
using runtime::Index;
using runtime::PerGroup;
using runtime::TaskContext;

namespace
{

/// Effects of the impulses at one node.
template <int D>
struct NodeImpulses {
  /// Impulses on each material [N s]; their sum is zero.
  std::array<Vector<D>, PerGroup<int>::max_groups> impulse;
  /// The energy that they took [J]: each times the mean of the velocities before and after the step, as the energies of
  /// leapfrog are counted. Forces that contact balances then take nothing, however hard they press.
  double energy = 0;

  void add(std::size_t material, const Vector<D>& value, const Vector<D>& before, const Vector<D>& after)
  {
    impulse[material] = value;
    energy -= 0.5 * value.dot(before + after);
  }
};

/// Gives the node `i` at `x` its velocities after the impulses; a rigid body's stays, and it takes what the
/// others together gave.
template <int D>
NodeImpulses<D> write_back(const Method<D>& method, const NodeOfMaterials<D>& node, const RigidBody* rigid,
                           const RigidStates& at_step_start, const PerGroup<GridView<const NodeSums<D>>>& sums,
                           const PerGroup<GridView<NodeMotion<D>>>& motions, const Index& i, const Vector<D>& x)
{
  const auto at_start = [&](std::size_t g) { return Vector<D>(sums[g][i].momentum() / sums[g][i].mass()); };
  NodeImpulses<D> done;
  Vector<D> given = Vector<D>::Zero();
  for (const int material : method.deformable_materials) {
    const auto g = static_cast<std::size_t>(material);
    if (!(node.mass[g] > method.least_node_mass)) continue;
    NodeMotion<D>& motion = motions[g][i];
    const Vector<D> change = node.velocity[g] - motion.velocity();
    done.add(g, node.mass[g] * change, at_start(g), node.velocity[g]);
    given += done.impulse[g];
    motion.set(node.velocity[g], motion.velocity_change() + change);
  }
  if (rigid == nullptr) return done;
  const auto g = static_cast<std::size_t>(rigid->material);
  const components::RigidMotion before = components::motion_of(rigid->properties, at_step_start.of(*rigid));
  done.add(g, -given, before.at(in_space<D>(x)).template head<D>(), node.velocity[g]);
  return done;
}

template <int D>
void add_impulses(const Method<D>& method, const NodeOfMaterials<D>& node, const RigidStates& at_step_start,
                  const NodeImpulses<D>& done, const Vector<D>& x, ContactImpulses& impulses)
{
  for (std::size_t g = 0; g < method.materials.size(); ++g) {
    if (!(node.mass[g] > method.least_node_mass)) continue;
    impulses.by_material[g].linear += in_space<D>(done.impulse[g]);
  }
  for (const RigidBody& body : method.rigid_bodies) {
    const auto g = static_cast<std::size_t>(body.material);
    if (!(node.mass[g] > method.least_node_mass)) continue;
    const Eigen::Vector3d arm = in_space<D>(x) - at_step_start.of(body).centre;
    impulses.by_material[g].angular += arm.cross(in_space<D>(done.impulse[g]));
  }
}

}  // namespace

template <int D>
runtime::TaskList contact(const Method<D>& method)
{
  return {runtime::task("contact")
              .over_patches()
              .sparse(runtime::Sparsity::no_pair)
              .reads(rigid_states.previous(), node::sums<D>.halo(method.halo).every_group(),
                     node::contact_face<D>.halo(method.halo).every_group().when(method.contacts.finds_faces()))
              .updates(node::motion<D>.halo(method.halo).every_group())
              .reduces(step_totals, contact_impulses)
              .body([&method](const TaskContext& at, auto data) {
                const auto sums = data[node::sums<D>];
                const auto motions = data[node::motion<D>];
                const auto faces = data[node::contact_face<D>];
                const RigidStates& at_step_start = data[rigid_states.previous()];
                StepTotals& totals = data[step_totals];
                ContactImpulses& impulses = data[contact_impulses];
                const std::size_t n_groups = sums.size();
                const components::ContactThresholds thresholds = contact_thresholds(method);
                const runtime::IndexBox counted = counted_nodes(method, at);
                NodeOfMaterials<D> node;
                for_each(sums[0].box(), [&](const Index& i) {
                  if (!node.gather(method, sums, motions, faces, i)) return;
                  const RigidBody* rigid = node.rigid_body(method, at_step_start);
                  if (rigid != nullptr) {
                    node.mass[static_cast<std::size_t>(rigid->material)] = std::numeric_limits<double>::infinity();
                  }
                  const double approach_speed = components::resolve_contact<D>(
                      std::span(node.mass.data(), n_groups), node.surfaces(), method.contacts, thresholds,
                      std::span(node.velocity.data(), n_groups));
                  if (approach_speed == 0) return;
                  const Vector<D> x = node_position<D>(at.layout.grid(), i);
                  const NodeImpulses<D> done = write_back(method, node, rigid, at_step_start, sums, motions, i, x);
                  // Nodes on a seam are worked on by every patch around it, and counted by one.
                  if (!counted.contains(i)) return;
                  totals.contact += done.energy;
                  add_impulses(method, node, at_step_start, done, x, impulses);
                  if (method.time_step_rule == StepRule::viscous) {
                    totals.stable_step =
                        std::min(totals.stable_step, components::contact_time_step(method.cell_size, approach_speed));
                  }
                });
              })};
}

template runtime::TaskList contact(const Method<2>&);
template runtime::TaskList contact(const Method<3>&);

}  // namespace tamp::tasks
