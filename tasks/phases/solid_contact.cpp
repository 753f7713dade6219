#include "components/contact/solid_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "components/contact/friction.hpp"
#include "components/loads/time_step.hpp"
#include "components/rigid/rigid_contact.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/scatter.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::GapSums;
using components::NodeMotion;
using components::NodeSums;
using components::PlacedSolid;
using components::RigidMotion;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

/// Positions of the solids that a material meets, at the start of the step; valid until the next call on this thread.
template <int D>
std::span<const PlacedSolid<D>> solids_met_by(const Method<D>& method, int material, const RigidStates& states)
{
  thread_local std::vector<PlacedSolid<D>> placed;
  placed.clear();
  for (std::size_t b = 0; b < method.rigid_bodies.size(); ++b) {
    const RigidBody& body = method.rigid_bodies[b];
    if (!method.meets_by_solid(body, material)) continue;
    const components::RigidState& state = states.of(body);
    placed.push_back({b, method.solids[b], method.solids[b].bounding_box(),
                      state.orientation.toRotationMatrix().template topLeftCorner<D, D>(),
                      body.properties.centre.template head<D>(), state.centre.template head<D>()});
  }
  return placed;
}

/// A material and a rigid body at a node.
template <int D>
struct Touch {
  const RigidBody& body;
  Vector<D> normal;  ///< out of the body
  /// The speed that closes the whole gap within the step [m/s].
  double closing;

  /// The velocity of the material, with the closing of the gap added: there is contact only where the motion closes
  /// more than the gap.
  Vector<D> without_gap(const Vector<D>& velocity) const { return velocity + closing * normal; }
};

/// None where no particle near a body reaches the node. Throws SimulationError where two bodies are near.
template <int D>
std::optional<Touch<D>> touch_at(const Method<D>& method, const GapSums<D>& sums, double dt, const Vector<D>& x)
{
  if (!(sums.weight() > 0)) return {};
  const double body = std::round(sums.body());
  if (std::abs(sums.body() - body) > 1e-6) {
    throw SimulationError(
        "matter touches two rigid bodies at one node; one of them must be deformable, or finer cells "
        "lie between them",
        "", -1, {x.begin(), x.end()});
  }
  const Vector<D> normal = sums.normal();
  if (normal.isZero(0)) return {};
  // An overlap is not pushed out: where a fifth of it is in each step, runs of rigid_contact.json gain energy and fail.
  return Touch<D>{method.rigid_bodies[static_cast<std::size_t>(body)], normal, std::max(sums.gap(), 0.0) / dt};
}

template <int D>
Vector<D> velocity_at(const RigidMotion& motion, const Vector<D>& x)
{
  return motion.at(in_space<D>(x)).template head<D>();
}

template <int D>
runtime::TaskDeclaration find_gaps(const Method<D>& method)
{
  return runtime::task("find gaps")
      .over_patches_and_groups(method.touch_solids)
      .sparse()
      .reads(rigid_states.previous(), particle::position<D>.previous(), particle::deformation_gradient<D>.previous())
      .accumulates(node::gap_sums<D>.halo(method.halo))
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::gap_sums<D>];
        const auto solids = solids_met_by(method, at.group, data[rigid_states.previous()]);
        const double size = method.cell_size / method.scene.particles_per_axis_of(at.group);
        components::add_gaps<D>(method.interpolation(at.group), block_of<D>(at.layout, sums), places_at_start<D>(data),
                                size, solids, sums.data());
        fold_images(method, at, sums, true);
      });
}

/// Adds the contact at the nodes of a material to that of the bodies that it meets.
template <int D>
runtime::TaskDeclaration gather(const Method<D>& method)
{
  return runtime::task("gather contact of solids")
      .over_patches_and_groups(method.touch_solids)
      .sparse()
      .reads(rigid_states.previous(), free_rigid_states, node::sums<D>.halo(method.halo),
             node::motion<D>.halo(method.halo), node::gap_sums<D>.halo(method.halo))
      .reduces(rigid_couplings)
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motion = data[node::motion<D>];
        const auto gaps = data[node::gap_sums<D>];
        const RigidStates& before = data[rigid_states.previous()];
        const RigidStates& free = data[free_rigid_states];
        RigidCouplings& couplings = data[rigid_couplings];
        for_each(at.layout.owned_nodes(at.patch), [&](const Index& i) {
          if (!(sums[i].mass() > method.least_node_mass)) return;
          const Vector<D> x = node_position<D>(at.layout.grid(), i);
          const auto touch = touch_at<D>(method, gaps[i], at.step.size, x);
          if (!touch) return;
          const RigidBody& body = touch->body;
          const components::NodeContact contact = components::node_contact(
              sums[i].mass(), in_space<D>(touch->normal), method.contacts.friction(body.material, at.group),
              in_space<D>(velocity_at<D>(components::motion_of(body.properties, free.of(body)), x)),
              in_space<D>(touch->without_gap(motion[i].velocity())));
          couplings.by_material[static_cast<std::size_t>(body.material)].add(contact,
                                                                             in_space<D>(x) - before.of(body).centre);
        });
      });
}

/// The motions of a rigid body at the start of the step and once contact is known.
struct BodyMotions {
  RigidMotion before, after;
};

/// Applies contact at the nodes of a material.
template <int D>
class NodesOnSolids
{
 public:
  NodesOnSolids(const Method<D>& method, const TaskContext& at, const RigidStates& before, const RigidStates& free,
                const RigidCouplings& couplings)
      : method_(method), at_(at), before_(before)
  {
    for (const RigidBody& body : method.rigid_bodies) {
      if (!method.meets_by_solid(body, at.group)) continue;
      const auto g = static_cast<std::size_t>(body.material);
      motions_[g] = {components::motion_of(body.properties, before.of(body)),
                     couplings.by_material[g].solve(body.properties, free.of(body), body.held())};
    }
  }

  /// Applies contact at the node `i`. Only nodes with `is_counted` add to the sums over all nodes.
  void push(const NodeSums<D>& sums, const GapSums<D>& gaps, const Index& i, bool is_counted, NodeMotion<D>& motion,
            StepTotals& totals, ContactImpulses& impulses) const
  {
    const Vector<D> x = node_position<D>(at_.layout.grid(), i);
    const auto touch = touch_at<D>(method_, gaps, at_.step.size, x);
    if (!touch) return;
    const RigidBody& body = touch->body;
    const BodyMotions& motions = motions_[static_cast<std::size_t>(body.material)];
    Vector<D> of_body = velocity_at<D>(motions.after, x), of_matter = touch->without_gap(motion.velocity());
    const components::ContactImpulse<D> impulse =
        components::collide<D>(std::numeric_limits<double>::infinity(), sums.mass(), touch->normal,
                               method_.contacts.friction(body.material, at_.group), of_body, of_matter);
    if (impulse.approach_speed == 0) return;
    const Vector<D> change = impulse.on_second / sums.mass(), velocity = motion.velocity() + change;
    motion.set(velocity, motion.velocity_change() + change);
    if (!is_counted) return;
    // Each impulse times the mean of the velocities before and after the step, as the energies of leapfrog are counted.
    const Vector<D> at_start = sums.momentum() / sums.mass();
    totals.contact -= 0.5 * impulse.on_second.dot(at_start + velocity - velocity_at<D>(motions.before, x) - of_body);
    if (method_.time_step_rule == StepRule::viscous) {
      totals.stable_step =
          std::min(totals.stable_step, components::contact_time_step(method_.cell_size, impulse.approach_speed));
    }
    const Eigen::Vector3d given = in_space<D>(impulse.on_second);
    impulses.by_material[static_cast<std::size_t>(at_.group)].linear += given;
    ContactImpulses::Impulse& on_body = impulses.by_material[static_cast<std::size_t>(body.material)];
    on_body.linear -= given;
    on_body.angular -= (in_space<D>(x) - before_.of(body).centre).cross(given);
  }

 private:
  const Method<D>& method_;
  const TaskContext& at_;
  const RigidStates& before_;
  /// By material.
  std::array<BodyMotions, runtime::PerGroup<int>::max_groups> motions_;
};

template <int D>
runtime::TaskDeclaration push(const Method<D>& method)
{
  return runtime::task("contact of solids")
      .over_patches_and_groups(method.touch_solids)
      .sparse()
      .reads(rigid_states.previous(), free_rigid_states, rigid_couplings, node::sums<D>.halo(method.halo),
             node::gap_sums<D>.halo(method.halo))
      .updates(node::motion<D>.halo(method.halo))
      .reduces(solid_totals, contact_impulses)
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto gaps = data[node::gap_sums<D>];
        const auto motion = data[node::motion<D>];
        const NodesOnSolids<D> nodes(method, at, data[rigid_states.previous()], data[free_rigid_states],
                                     data[rigid_couplings]);
        const runtime::IndexBox counted = counted_nodes(method, at);
        for_each(motion.box(), [&](const Index& i) {
          if (!(sums[i].mass() > method.least_node_mass)) return;
          nodes.push(sums[i], gaps[i], i, counted.contains(i), motion[i], data[solid_totals], data[contact_impulses]);
        });
      });
}

}  // namespace

template <int D>
runtime::TaskList gather_contact_of_solids(const Method<D>& method)
{
  if (method.touch_solids.empty()) return {};
  return {find_gaps(method), gather(method)};
}

template <int D>
runtime::TaskList contact_of_solids(const Method<D>& method)
{
  if (method.touch_solids.empty()) return {};
  return {push(method)};
}

template runtime::TaskList gather_contact_of_solids(const Method<2>&);
template runtime::TaskList gather_contact_of_solids(const Method<3>&);
template runtime::TaskList contact_of_solids(const Method<2>&);
template runtime::TaskList contact_of_solids(const Method<3>&);

}  // namespace tamp::tasks
