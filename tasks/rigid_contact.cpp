#include "components/rigid/rigid_contact.hpp"

#include <algorithm>

#include "components/contact/friction.hpp"
#include "components/loads/time_step.hpp"
#include "tasks/contact_nodes.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::NodeContact;
using components::NodeMotion;
using components::NodeSums;
using runtime::GridView;
using runtime::Index;
using runtime::PerGroup;
using runtime::TaskContext;

namespace
{

/// What the materials at a node ask of the rigid body there.
template <int D>
void add_node(const Method<D>& method, const RigidBody& body, const NodeOfGroups<D>& node, const Vector<D>& x,
              RigidCouplings& couplings)
{
  const auto self = static_cast<std::size_t>(body.group);
  for (const int g : method.deformable_groups) {
    const auto other = static_cast<std::size_t>(g);
    if (!(node.mass[other] > method.least_node_mass)) continue;
    const Vector<D> outward = components::outward_of<D>(method.contacts, body.group, g, node.surface_gradient[self],
                                                        node.surface_gradient[other]);
    const double length = outward.norm();
    if (!(length > contact_thresholds(method).surface_gradient)) continue;
    const NodeContact contact = components::node_contact(
        node.mass[other], in_space<D>(outward / length), method.contacts.friction(body.group, g),
        in_space<D>(node.velocity[self]), in_space<D>(node.velocity[other]));
    couplings.by_group[self].add(contact, in_space<D>(x) - body.state.centre);
  }
}

}  // namespace

template <int D>
runtime::TaskDeclaration release_rigid_nodes(const Method<D>& method, int group)
{
  const std::string& name = method.materials[static_cast<std::size_t>(group)].name;
  return runtime::task("release rigid nodes: " + name)
      .over_patches_and_groups({group})
      .sparse()
      .reads(node::sums<D>.halo(method.halo))
      .computes(node::motion<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motion = data[node::motion<D>];
        const RigidBody& body = *method.rigid_body(at.group);
        const components::RigidMotion free = components::motion_of(body.properties, body.free);
        for_each(motion.box(), [&](const Index& i) {
          motion[i] = {};
          if (!(sums[i].mass() > 0)) return;
          motion[i].set(free.at(in_space<D>(place_of<D>(at.layout.grid(), i))).template head<D>(), Vector<D>::Zero());
        });
      });
}

/// All nodes of a rigid body share its six degrees of freedom, so its contact is gathered from all patches before any
/// of them can say how fast it moves.
template <int D>
runtime::TaskDeclaration gather_rigid_contact(const Method<D>& method)
{
  return runtime::task("gather rigid contact")
      .over_patches()
      .sparse()
      .reads(node::sums<D>.halo(method.halo).every_group(), node::motion<D>.halo(method.halo).every_group())
      .reduces(rigid_couplings)
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motions = data[node::motion<D>];
        RigidCouplings& couplings = data[rigid_couplings];
        NodeOfGroups<D> node;
        for_each(at.layout.owned_nodes(at.patch), [&](const Index& i) {
          if (node.gather(method, sums, motions, i) < 2) return;
          if (const RigidBody* body = node.rigid_body(method)) {
            add_node(method, *body, node, place_of<D>(at.layout.grid(), i), couplings);
          }
        });
      });
}

/// Nodes of rigid bodies take the velocity that the bodies have after contact.
template <int D>
runtime::TaskDeclaration move_rigid_nodes(const Method<D>& method)
{
  return runtime::task("move rigid nodes")
      .over_patches()
      .sparse()
      .reads(rigid_couplings, node::sums<D>.halo(method.halo).every_group())
      .updates(node::motion<D>.halo(method.halo).every_group())
      .body([&method](const TaskContext& at, auto data) {
        const RigidCouplings& couplings = data[rigid_couplings];
        const auto sums = data[node::sums<D>];
        const auto motions = data[node::motion<D>];
        for (const RigidBody& body : method.rigid_bodies) {
          const auto g = static_cast<std::size_t>(body.group);
          const components::RigidMotion motion = couplings.by_group[g].solve(body.properties, body.free);
          for_each(motions[g].box(), [&](const Index& i) {
            if (!(sums[g][i].mass() > 0)) return;
            const Vector<D> velocity = motion.at(in_space<D>(place_of<D>(at.layout.grid(), i))).template head<D>();
            motions[g][i].set(velocity, Vector<D>::Zero());
          });
        }
      });
}

/// A rigid body's particles keep their places in it.
template <int D>
runtime::TaskDeclaration move_rigid_body(const Method<D>& method, int group)
{
  const std::string& name = method.materials[static_cast<std::size_t>(group)].name;
  return runtime::task("move rigid body: " + name)
      .over_patches_and_groups({group})
      .reads(contact_impulses, particle::id.previous(), particle::reference_position<D>.previous(),
             particle::volume.previous())
      .computes(particle::position<D>, particle::velocity<D>, particle::deformation_gradient<D>, particle::volume,
                particle::stress<D>, particle::viscous_pressure)
      .reduces(step_totals)
      .body([&method](const TaskContext& at, auto data) {
        const ContactImpulses& impulses = data[contact_impulses];
        const auto id = data[particle::id.previous()];
        const auto reference = data[particle::reference_position<D>.previous()];
        const auto old_volume = data[particle::volume.previous()];
        const auto position = data[particle::position<D>];
        const auto velocity = data[particle::velocity<D>];
        const auto deformation = data[particle::deformation_gradient<D>];
        const auto volume = data[particle::volume];
        const auto stress = data[particle::stress<D>];
        const auto viscous_pressure = data[particle::viscous_pressure];
        StepTotals& totals = data[step_totals];
        const RigidBody& body = *method.rigid_body(at.group);
        const auto state = moved(body, impulses.by_group[static_cast<std::size_t>(at.group)], at.step.size);
        const components::RigidMotion motion = components::motion_of(body.properties, state);
        const Matrix<D> turn = state.orientation.toRotationMatrix().template topLeftCorner<D, D>();
        const Vector<D> start = body.properties.centre.template head<D>(), centre = state.centre.template head<D>();
        for (std::size_t p = 0; p < id.size(); ++p) {
          position[p] = centre + turn * (reference[p] - start);
          velocity[p] = motion.at(in_space<D>(position[p])).template head<D>();
          deformation[p] = turn;
          volume[p] = old_volume[p];
          stress[p].setZero();
          viscous_pressure[p] = 0;
          if (!is_off_edges<D>(at.layout.grid(), method.scene.reach_of(at.group), position[p])) {
            throw SimulationError("a rigid body reaches the edge of the domain, where nothing is known to hold it",
                                  method.materials[static_cast<std::size_t>(at.group)].name, id[p],
                                  {position[p].begin(), position[p].end()});
          }
          totals.stable_step =
              std::min(totals.stable_step, components::published_time_step<D>(method.cell_size, 0, velocity[p]));
        }
      });
}

template runtime::TaskDeclaration release_rigid_nodes(const Method<2>&, int);
template runtime::TaskDeclaration release_rigid_nodes(const Method<3>&, int);
template runtime::TaskDeclaration gather_rigid_contact(const Method<2>&);
template runtime::TaskDeclaration gather_rigid_contact(const Method<3>&);
template runtime::TaskDeclaration move_rigid_nodes(const Method<2>&);
template runtime::TaskDeclaration move_rigid_nodes(const Method<3>&);
template runtime::TaskDeclaration move_rigid_body(const Method<2>&, int);
template runtime::TaskDeclaration move_rigid_body(const Method<3>&, int);

}  // namespace tamp::tasks
