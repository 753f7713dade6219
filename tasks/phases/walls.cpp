#include "tasks/phases/walls.hpp"

#include <algorithm>

#include "components/contact/wall_gaps.hpp"
#include "components/loads/local_damping.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/kick.hpp"
#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using components::WallGaps;
using runtime::GridView;
using runtime::Index;
using runtime::PerGroup;
using runtime::TaskContext;

namespace
{

/// Adds what the particles of one material take from the nodes that this patch counts, and the energy that particles
/// filter out there.
template <int D>
void add_taken(const Method<D>& method, const TaskContext& at, const GridView<const NodeSums<D>>& sums,
               const GridView<NodeMotion<D>>& motion, GridTotals& totals)
{
  const bool in_whole = method.deforms_by_other_velocities();
  const double half_step_before = 0.5 * at.step.previous_size, half_step = 0.5 * at.step.size;
  for_each(counted_nodes(method, at), [&](const Index& i) {
    const Vector<D> change = motion[i].velocity_change(), at_end = motion[i].velocity(), at_start = at_end - change;
    for (std::size_t k = 0; k < std::size_t{D}; ++k) {
      totals.impulse[k] += own_mass(method, at, sums, i, k) * change[static_cast<int>(k)];
    }
    totals.gained_by_nodes += 0.5 * sums[i].mass() * change.dot(at_start + at_end);
    const Vector<D> force = sums[i].internal_force();
    totals.taken_by_forces -= in_whole ? 0.5 * (half_step_before + half_step) * force.dot(at_start + at_end)
                                       : half_step_before * force.dot(at_start);
  });
}

/// Leaves a node the velocity `left`, and counts the energy that the wall takes: each impulse times the mean of the
/// velocities before and after the step, as the energies of leapfrog are counted.
template <int D>
void leave(const Vector<D>& left, const NodeSums<D>& sums, bool is_counted, NodeMotion<D>& motion, GridTotals& totals)
{
  const Vector<D> arriving = motion.velocity(), at_start = sums.momentum() / sums.mass();
  motion.set(left, motion.velocity_change() + left - arriving);
  if (is_counted) totals.taken_by_walls += 0.5 * sums.mass() * (arriving - left).dot(at_start + left);
}

/// Applies a wall that is no mirror to the motion of its nodes.
template <int D>
void hold(const Method<D>& method, const TaskContext& at, const Wall<D>& wall, const GridView<const NodeSums<D>>& sums,
          const GridView<NodeMotion<D>>& motion, GridTotals& totals)
{
  const runtime::IndexBox counted = counted_nodes(method, at);
  components::with_wall(wall.face, [&](const auto& kind) {
    for_each_wall_node(wall, at.layout.grid(), motion.box(), [&](const Index& i) {
      if (!(sums[i].mass() > method.least_node_mass)) return;
      leave<D>(kind.template velocity<D>(motion[i].velocity(), wall.node), sums[i], counted.contains(i), motion[i],
               totals);
    });
  });
}

/// The velocity of a node once a wall has pushed it off, if the gap would close within the step, as contact with the
/// solid of a rigid body does.
template <int D>
Vector<D> pushed_off(const Method<D>& method, const TaskContext& at, const components::PlaneWall& wall, double gap,
                     const Vector<D>& velocity)
{
  Vector<D> closing = Vector<D>::Zero();
  closing[wall.axis] = wall.outside * std::max(gap, 0.0) / at.step.size;
  Vector<D> left = velocity;
  if (!(wall.outside * (velocity - closing)[wall.axis] > 0)) return left;
  components::with_wall(method.face(wall), [&](const auto& kind) {
    const components::WallNode node{wall.axis, wall.outside, method.cell_size, at.step.size};
    left = kind.template velocity<D>(velocity - closing, node) + closing;
  });
  return left;
}

/// Applies the walls that are touched at edges; where several meet, one after another, and their work is that of all.
template <int D>
void push_off(const Method<D>& method, const TaskContext& at, const GridView<const NodeSums<D>>& sums,
              const GridView<const WallGaps<D>>& gaps, const GridView<NodeMotion<D>>& motion, GridTotals& totals)
{
  const runtime::IndexBox counted = counted_nodes(method, at);
  for (std::size_t w = 0; w < method.edge_walls.size(); ++w) {
    const auto behind = [&](std::size_t other) {
      return nodes_behind(method.edge_walls[other], at.layout.grid(), motion.box());
    };
    for_each(behind(w), [&](const Index& i) {
      if (!(sums[i].mass() > method.least_node_mass)) return;
      Vector<D> velocity = motion[i].velocity();
      for (std::size_t other = 0; other < method.edge_walls.size(); ++other) {
        const components::PlaneWall& wall = method.edge_walls[other];
        if (!behind(other).contains(i)) continue;
        if (other < w) return;
        if (gaps[i].weight(wall) > 0) velocity = pushed_off(method, at, wall, gaps[i].gap(wall), velocity);
      }
      if (velocity != motion[i].velocity()) leave(velocity, sums[i], counted.contains(i), motion[i], totals);
    });
  }
}

/// Local damping of what forces, contact and walls together leave unbalanced, where they have not brought the node to
/// rest. The energy that it takes is its impulse
/// times the mean of the velocities before and after the step. Contact and walls have counted theirs with the velocity
/// that they left, so that what damping changes in theirs counts here.
template <int D>
void damp(const Method<D>& method, const TaskContext& at, const GridView<const NodeSums<D>>& sums,
          const GridView<NodeMotion<D>>& motion, GridTotals& totals)
{
  const runtime::IndexBox counted = counted_nodes(method, at);
  for_each(motion.box(), [&](const Index& i) {
    const double mass = sums[i].mass();
    if (!(mass > method.least_node_mass)) return;
    const Vector<D> at_start = sums[i].momentum() / mass, change = motion[i].velocity_change();
    Vector<D> damped = components::damped_change<D>(at_start, change, method.damping), at_end = at_start + damped;
    for (int k = 0; k < D; ++k) {
      if (motion[i].velocity()[k] != 0) continue;
      damped[k] = change[k];
      at_end[k] = 0;
    }
    motion[i].set(at_end, damped);
    if (!counted.contains(i)) return;
    const Vector<D> held = change - kicked(method, at, i, sums[i]);
    totals.taken_by_damping += 0.5 * mass * (change - damped).dot(at_start + motion[i].velocity() + held);
  });
}

}  // namespace

/// The image of a particle takes as much normal momentum to the nodes of the wall as the particle brings: there the
/// normal velocity is zero before and after the step, and the nodes behind the wall mirror those before it. A wall with
/// friction pushes back what runs into its nodes, and no more than friction times that push along it; one without slip
/// stops them. Local damping comes here too, as it acts on what walls leave and the mirrored nodes are to have it.
template <int D>
runtime::TaskList walls(const Method<D>& method)
{
  return {
      runtime::task("walls")
          .over_patches()
          .sparse()
          .reads(node::sums<D>.halo(method.halo).every_group(),
                 node::wall_gaps<D>.halo(method.halo).every_group().when(!method.edge_walls.empty()))
          .updates(node::motion<D>.halo(method.halo).every_group())
          .reduces(grid_totals)
          .body([&method](const TaskContext& at, auto data) {
            const auto sums = data[node::sums<D>];
            const auto gaps = data[node::wall_gaps<D>];
            const auto motions = data[node::motion<D>];
            for (std::size_t g = 0; g < motions.size(); ++g) {
              const GridView<NodeMotion<D>>& motion = motions[g];
              for_each_wall(method, at, motion.box(), [&](const Wall<D>& wall) {
                if (wall.traits.is_mirror) wall.image.constrain(motion.data());
              });
              for_each_wall(method, at, motion.box(),
                            [&](const Wall<D>& wall) { hold(method, at, wall, sums[g], motion, data[grid_totals]); });
              if (!method.edge_walls.empty()) push_off(method, at, sums[g], gaps[g], motion, data[grid_totals]);
              if (method.damping > 0 && method.rigid_body(static_cast<int>(g)) == nullptr) {
                damp(method, at, sums[g], motion, data[grid_totals]);
              }
              for_each_wall(method, at, motion.box(), [&](const Wall<D>& wall) { wall.image.mirror(motion.data()); });
              add_taken(method, at, sums[g], motion, data[grid_totals]);
            }
          })};
}

template runtime::TaskList walls(const Method<2>&);
template runtime::TaskList walls(const Method<3>&);

}  // namespace tamp::tasks
