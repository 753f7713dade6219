#include <array>
#include <cmath>

#include "components/contact/friction.hpp"
#include "components/loads/time_step.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases.hpp"

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

/// The materials at one node, side by side.
template <int D>
struct NodeOfGroups {
  std::array<double, PerGroup<int>::max_groups> mass;
  std::array<Vector<D>, PerGroup<int>::max_groups> surface_gradient;
  std::array<Vector<D>, PerGroup<int>::max_groups> velocity;

  /// How many of the groups have mass here.
  int gather(double least_node_mass, const PerGroup<GridView<const NodeSums<D>>>& sums,
             const PerGroup<GridView<NodeMotion<D>>>& motions, const Index& i)
  {
    int n_present = 0;
    for (std::size_t g = 0; g < sums.size(); ++g) {
      const NodeSums<D>& node = sums[g][i];
      mass[g] = node.mass();
      if (mass[g] > least_node_mass) ++n_present;
      surface_gradient[g] = node.surface_gradient();
      velocity[g] = motions[g][i].velocity();
    }
    return n_present;
  }

  /// Hands on the velocities after the impulses, and returns the energy that the impulses took [J]: each times the mean
  /// of the velocities before and after the step, as the energies of leapfrog are counted. Forces that contact balances
  /// then take nothing, however hard they press.
  double give_back(double least_node_mass, const PerGroup<GridView<const NodeSums<D>>>& sums,
                   const PerGroup<GridView<NodeMotion<D>>>& motions, const Index& i) const
  {
    double taken = 0;
    for (std::size_t g = 0; g < motions.size(); ++g) {
      if (!(mass[g] > least_node_mass)) continue;
      NodeMotion<D>& motion = motions[g][i];
      const Vector<D> change = velocity[g] - motion.velocity();
      const Vector<D> at_start = sums[g][i].momentum() / mass[g];
      taken -= 0.5 * mass[g] * change.dot(at_start + velocity[g]);
      motion.set(velocity[g], motion.velocity_change() + change);
    }
    return taken;
  }
};

}  // namespace

template <class Interpolator>
runtime::TaskDeclaration contact(const Method<Interpolator>& method)
{
  constexpr int D = Interpolator::dimension;
  return runtime::task("contact")
      .over_patches()
      .reads(node::sums<D>.halo(1).every_group())
      .updates(node::motion<D>.halo(1).every_group())
      .reduces(step_totals)
      .body([&method](const TaskContext& at, const PerGroup<GridView<const NodeSums<D>>>& sums,
                      const PerGroup<GridView<NodeMotion<D>>>& motions, StepTotals& totals) {
        totals.host_requests = at.step.host_requests;
        const std::size_t n_groups = sums.size();
        const components::ContactThresholds thresholds{method.least_node_mass,
                                                       1e-9 * std::pow(method.cell_size, D - 1)};
        const runtime::IndexBox owned = at.layout.owned_nodes(at.patch);
        NodeOfGroups<D> node;
        for_each(sums[0].box(), [&](const Index& i) {
          if (node.gather(method.least_node_mass, sums, motions, i) < 2) return;
          const auto outcome = components::resolve_contact<D>(
              std::span(node.mass.data(), n_groups), std::span(node.surface_gradient.data(), n_groups), method.friction,
              thresholds, std::span(node.velocity.data(), n_groups));
          if (outcome.approach_speed == 0) return;
          const double taken = node.give_back(method.least_node_mass, sums, motions, i);
          // Nodes on a seam are worked on by every patch around it, and counted by one.
          if (!owned.contains(i)) return;
          totals.contact += taken;
          if (method.time_step_rule == StepRule::viscous) {
            totals.stable_step =
                std::min(totals.stable_step, components::contact_time_step(method.cell_size, outcome.approach_speed));
          }
        });
      });
}

template runtime::TaskDeclaration contact(const Method<components::Gimp<2>>&);
template runtime::TaskDeclaration contact(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
