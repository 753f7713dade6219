#pragma once

#include <array>
#include <cstddef>
#include <string_view>

#include "components/boundary/face.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

struct SymmetryFace {
  static constexpr std::string_view word = "symmetry",
                                    meaning = "a smooth wall, with the mirror image of the material behind it";
  static constexpr FaceTraits traits() { return {.is_mirror = true}; }
  friend bool operator==(const SymmetryFace&, const SymmetryFace&) = default;
};

/// A mirror wall through the nodes of one plane of a block of nodes, for interpolators whose support reaches one node
/// layer (the ghost layer) beyond it: the fields behave as if the mirror image of the material stood outside. Fields
/// are linear arrays of the block, x fastest, of values that know their `mirrored(axis)`, can `hold_on_mirror(axis)`
/// (drop what is normal to it), and be added. Where walls meet, apply each function for one axis after another: the
/// ghosts of the corner then get their images of images, in any order of the axes.
///
/// On the wall's own nodes the image would add as much again as the inside did, to masses, forces and tangential
/// momenta alike. These nodes keep the half of the inside instead: their velocities and accelerations are the same, and
/// sums over a half model are sums over half a body.
template <int D>
class SymmetryWall
{
 public:
  /// A wall normal to `axis` through the nodes with index `plane` on that axis; the ghost layer is at plane + outside,
  /// outside being -1 or +1. Throws BadValue if the block lacks the ghost layer, or the layer that mirrors it.
  SymmetryWall(const std::array<int, std::size_t{D}>& n_nodes, int axis, int plane, int outside);

  /// Adds to each inside neighbour of the wall what the image scatters there: the ghost's value mirrored. On the wall
  /// the image takes the normal components away. Ghosts keep what was scattered to them. Once a step, on parts or sums.
  template <class Value>
  void fold(Value* field) const
  {
    add_image(field);
    constrain(field);
  }
  /// Adds the image, but leaves the normal components on the wall as the inside gave them.
  template <class Value>
  void add_image(Value* field) const
  {
    for_each_node(
        [&](std::size_t, std::size_t ghost, std::size_t inside) { field[inside] += field[ghost].mirrored(axis_); });
  }

  /// Takes the normal components away on the wall, so that nothing crosses it.
  template <class Value>
  void constrain(Value* field) const
  {
    for_each_node([&](std::size_t wall, std::size_t, std::size_t) { field[wall].hold_on_mirror(axis_); });
  }
  /// Writes to each ghost the mirrored value of its mirror node. After walls of all axes are constrained.
  template <class Value>
  void mirror(Value* field) const
  {
    for_each_node(
        [&](std::size_t, std::size_t ghost, std::size_t inside) { field[ghost] = field[inside].mirrored(axis_); });
  }
  /// Makes the inverse masses of nodes what they are in the whole: half as much on the wall, where the image adds as
  /// much again to the mass, and beyond it those of the mirror nodes.
  void complete_inverse_masses(double* inverse_mass) const
  {
    for_each_node([&](std::size_t wall, std::size_t ghost, std::size_t inside) {
      inverse_mass[wall] *= 0.5;
      inverse_mass[ghost] = inverse_mass[inside];
    });
  }

 private:
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
