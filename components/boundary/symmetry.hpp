#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "components/tensors.hpp"

namespace tamp::components
{

/// A mirror wall through the nodes of one plane of a block of nodes, for interpolators whose support reaches one node
/// layer (the ghost layer) beyond it: the fields behave as if the mirror image of the material stood outside. Fields
/// are linear arrays of the block, x fastest. Where walls meet, apply each function for one axis after another: the
/// ghosts of the corner then get their images of images, in any order of the axes.
///
/// On the wall's own nodes the image would add as much again as the inside did, to masses, forces and tangential
/// momenta alike. These nodes keep the half of the inside instead: their velocities and accelerations are the same, and
/// sums over a half model are sums over half a body. The surface gradients of contact are a vector field like momentum:
/// fold and constrain them too, or the missing image tilts the normals on the wall.
template <int D>
class SymmetryWall
{
 public:
  /// A wall normal to `axis` through the nodes with index `plane` on that axis; the ghost layer is at plane + outside,
  /// outside being -1 or +1. Throws BadValue if the block lacks the ghost layer, or the layer that mirrors it.
  SymmetryWall(const std::array<int, std::size_t{D}>& n_nodes, int axis, int plane, int outside);

  /// Calls visit(wall node, ghost, mirror node), as places in the block, for every node of the wall.
  template <class Visit>
  void for_each_node(Visit&& visit) const
  {
    for (std::ptrdiff_t j = 0; j < n_across_[1]; ++j) {
      for (std::ptrdiff_t i = 0; i < n_across_[0]; ++i) {
        const std::ptrdiff_t node = first_ + i * step_across_[0] + j * step_across_[1];
        visit(static_cast<std::size_t>(node), static_cast<std::size_t>(node + to_ghost_),
              static_cast<std::size_t>(node - to_ghost_));
      }
    }
  }

  /// Adds to each inside neighbour of the wall what the image scatters there: the ghost's value, with the normal
  /// component of vectors reversed. Ghosts keep what was scattered to them. Once a step, on complete sums.
  void fold(std::span<double> field) const;
  void fold(std::span<Vector<D>> field) const;

  /// Writes to each ghost the value of its mirror node.
  void mirror(std::span<double> field) const;

  /// Sets the normal component on the wall to 0, so that nothing crosses it, and writes to each ghost the vector of its
  /// mirror node with the normal component reversed.
  void constrain_and_mirror(std::span<Vector<D>> field) const;

 private:
  Vector<D> reversed(Vector<D> v) const
  {
    v[axis_] = -v[axis_];
    return v;
  }

  int axis_;
  /// Places: of the wall's first node, and steps from a wall node to its ghost (inside lies as far the other way).
  std::ptrdiff_t first_ = 0;
  std::ptrdiff_t to_ghost_;
  /// The wall's nodes: counts and steps along the other axes.
  std::array<std::ptrdiff_t, 2> n_across_{1, 1};
  std::array<std::ptrdiff_t, 2> step_across_{0, 0};
};

extern template class SymmetryWall<2>;
extern template class SymmetryWall<3>;

}  // namespace tamp::components
