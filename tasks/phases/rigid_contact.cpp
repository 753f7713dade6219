#include "components/rigid/rigid_contact.hpp"

#include <algorithm>

#include "components/contact/friction.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/contact_nodes.hpp"
#include "tasks/phases/phases.hpp"
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

/// Adds the contact of the materials at a node with the rigid body there.
template <int D>
void add_node(const Method<D>& method, const RigidBody& body, const RigidStates& states, const NodeOfMaterials<D>& node,
              const Vector<D>& x, RigidCouplings& couplings)
{
  const auto self = static_cast<std::size_t>(body.material);
  for (const int g : method.deformable_materials) {
    const auto other = static_cast<std::size_t>(g);
    if (!(node.mass[other] > method.least_node_mass)) continue;
    const auto normal = components::normal_at<D>(method.contacts, body.material, g, node.surfaces(),
                                                 contact_thresholds(method).surface_gradient);
    if (!normal) continue;
    const NodeContact contact =
        components::node_contact(node.mass[other], in_space<D>(*normal), method.contacts.friction(body.material, g),
                                 in_space<D>(node.velocity[self]), in_space<D>(node.velocity[other]));
    couplings.by_material[self].add(contact, in_space<D>(x) - states.of(body).centre);
  }
}

}  // namespace

template <int D>
runtime::TaskDeclaration move_rigid_nodes(const Method<D>& method, int material)
{
  const std::string& name = method.materials[static_cast<std::size_t>(material)].name;
  return runtime::task("rigid nodes before contact: " + name)
      .over_patches_and_groups({material})
      .sparse()
      .reads(free_rigid_states, node::sums<D>.halo(method.halo))
      .computes(node::motion<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motion = data[node::motion<D>];
        const RigidBody& body = *method.rigid_body(at.group);
        const components::RigidMotion free = components::motion_of(body.properties, data[free_rigid_states].of(body));
        for_each(motion.box(), [&](const Index& i) {
          motion[i] = {};
          if (!(sums[i].mass() > 0)) return;
          motion[i].set(free.at(in_space<D>(node_position<D>(at.layout.grid(), i))).template head<D>(),
                        Vector<D>::Zero());
        });
      });
}

template <int D>
runtime::TaskList rigid_nodes_before_contact(const Method<D>& method)
{
  runtime::TaskList tasks;
  for (const RigidBody& body : method.rigid_bodies) tasks.push_back(move_rigid_nodes(method, body.material));
  return tasks;
}

/// All nodes of a rigid body share its six degrees of freedom, so its contact is gathered from all patches before any
/// of them can say how fast it moves.
template <int D>
runtime::TaskList gather_rigid_contact(const Method<D>& method)
{
  if (method.rigid_bodies.empty()) return {};
  return {runtime::task("gather rigid contact")
              .over_patches()
              .sparse(runtime::Sparsity::no_pair)
              .reads(rigid_states.previous(), node::sums<D>.halo(method.halo).every_group(),
                     node::motion<D>.halo(method.halo).every_group(),
                     node::contact_face<D>.halo(method.halo).every_group().when(method.contacts.finds_faces()))
              .reduces(rigid_couplings)
              .body([&method](const TaskContext& at, auto data) {
                const auto sums = data[node::sums<D>];
                const auto motions = data[node::motion<D>];
                const auto faces = data[node::contact_face<D>];
                const RigidStates& states = data[rigid_states.previous()];
                RigidCouplings& couplings = data[rigid_couplings];
                NodeOfMaterials<D> node;
                for_each(at.layout.owned_nodes(at.patch), [&](const Index& i) {
                  if (!node.gather(method, sums, motions, faces, i)) return;
                  if (const RigidBody* body = node.rigid_body(method, states)) {
                    add_node(method, *body, states, node, node_position<D>(at.layout.grid(), i), couplings);
                  }
                });
              })};
}

/// Nodes of rigid bodies take the velocity that the bodies have after contact.
template <int D>
runtime::TaskList rigid_nodes_after_contact(const Method<D>& method)
{
  if (method.rigid_bodies.empty()) return {};
  return {runtime::task("rigid nodes after contact")
              .over_patches()
              .sparse()
              .reads(rigid_couplings, free_rigid_states, node::sums<D>.halo(method.halo).every_group())
              .updates(node::motion<D>.halo(method.halo).every_group())
              .body([&method](const TaskContext& at, auto data) {
                const RigidCouplings& couplings = data[rigid_couplings];
                const RigidStates& free = data[free_rigid_states];
                const auto sums = data[node::sums<D>];
                const auto motions = data[node::motion<D>];
                for (const RigidBody& body : method.rigid_bodies) {
                  const auto g = static_cast<std::size_t>(body.material);
                  const components::RigidMotion motion =
                      couplings.by_material[g].solve(body.properties, free.of(body), body.held());
                  for_each(motions[g].box(), [&](const Index& i) {
                    if (!(sums[g][i].mass() > 0)) return;
                    const Vector<D> velocity =
                        motion.at(in_space<D>(node_position<D>(at.layout.grid(), i))).template head<D>();
                    motions[g][i].set(velocity, Vector<D>::Zero());
                  });
                }
              })};
}

template runtime::TaskList rigid_nodes_before_contact(const Method<2>&);
template runtime::TaskList rigid_nodes_before_contact(const Method<3>&);
template runtime::TaskList gather_rigid_contact(const Method<2>&);
template runtime::TaskList gather_rigid_contact(const Method<3>&);
template runtime::TaskList rigid_nodes_after_contact(const Method<2>&);
template runtime::TaskList rigid_nodes_after_contact(const Method<3>&);

}  // namespace tamp::tasks
