#include "tasks/labels.hpp"
#include "tasks/phases.hpp"
#include "tasks/walls.hpp"

namespace tamp::tasks
{

using components::NodeMotion;
using components::NodeSums;
using components::SymmetryWall;
using runtime::GridView;
using runtime::Index;
using runtime::PerGroup;
using runtime::TaskContext;

namespace
{

/// What the particles of one group take from the nodes that this patch counts. Nodes inside a mirror also hold the
/// mass of the image, whose normal momentum is opposite: it is taken off again.
template <int D>
void add_impulse(const Method<D>& method, const TaskContext& at, const GridView<const NodeSums<D>>& sums,
                 const GridView<NodeMotion<D>>& motion, GridImpulse& impulse)
{
  for_each(counted_nodes(method, at), [&](const Index& i) {
    const Vector<D> change = motion[i].velocity_change();
    for (std::size_t k = 0; k < std::size_t{D}; ++k) {
      double mass = sums[i].mass();
      for (const int side : {0, 1}) {
        const int wall = side == 0 ? 0 : at.layout.grid().n_cells[k];
        const int outside = side == 0 ? -1 : 1;
        if (!method.mirrors[k][static_cast<std::size_t>(side)] || i[k] != wall - outside) continue;
        Index ghost = i;
        ghost[k] = wall + outside;
        mass -= 2 * sums[ghost].mass();
      }
      impulse.value[k] += mass * change[static_cast<int>(k)];
    }
  });
}

}  // namespace

/// The image of a particle takes as much normal momentum to the nodes of the wall as the particle brings: there the
/// normal velocity is zero before and after the step, and the nodes behind the wall mirror those before it.
template <int D>
runtime::TaskDeclaration symmetry_walls(const Method<D>& method)
{
  return runtime::task("symmetry walls")
      .over_patches()
      .sparse()
      .reads(node::sums<D>.halo(method.halo).every_group())
      .updates(node::motion<D>.halo(method.halo).every_group())
      .reduces(grid_impulse)
      .body([&method](const TaskContext& at, auto data) {
        const auto sums = data[node::sums<D>];
        const auto motions = data[node::motion<D>];
        GridImpulse& impulse = data[grid_impulse];
        for (std::size_t g = 0; g < motions.size(); ++g) {
          const GridView<NodeMotion<D>>& motion = motions[g];
          for_each_wall(method, at, motion.box(),
                        [&](const SymmetryWall<D>& wall) { wall.constrain_and_mirror(motion.data()); });
          add_impulse(method, at, sums[g], motion, impulse);
        }
      });
}

template runtime::TaskDeclaration symmetry_walls(const Method<2>&);
template runtime::TaskDeclaration symmetry_walls(const Method<3>&);

}  // namespace tamp::tasks
