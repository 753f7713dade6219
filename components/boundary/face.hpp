#pragma once

namespace tamp::components
{

/// What lies beyond a face of the grid, and so where material may go.
enum class Beyond {
  nothing,   ///< a wall
  away,      ///< out of the simulation
  opposite,  ///< in at the opposite face
};

/// Properties of all nodes of a face. Each kind of face has
///
///     word, meaning                                its name in scenes, unless it has parameters, and half a line
///     shown, parameters()                          if it has parameters: a scene then has an object of them, as shown
///     traits()                                     these
///     velocity(arriving, node)                     if it is a wall but no mirror: the velocity that it leaves a node,
///     carried_velocity(arriving, node)             and the same of velocities on which it has worked before, as
///                                                  particles bring back what they got from it
///
/// and is listed in faces.hpp.
struct FaceTraits {
  Beyond beyond = Beyond::nothing;
  /// Smooth: fields are those of a whole of which the grid has one half, so that bodies may be cut there.
  bool is_mirror = false;
  /// Whether its nodes keep what pushes them into it or off it, so that what touches it may leave.
  bool keeps_push = false;
  /// Whether matter touches the wall where the edges of its particles do; else where its nodes do, and behind them is a
  /// mirror image of the material.
  bool at_edges = false;

  constexpr bool is_wall() const { return beyond == Beyond::nothing; }
  constexpr bool has_image() const { return is_wall() && !at_edges; }
};

/// A node of a wall, as the wall's velocity rule sees it.
struct WallNode {
  int axis;          ///< axis that the wall is normal to
  int outside;       ///< the side of the grid that it is on, -1 or +1
  double cell_size;  ///< m
  double step;       ///< s
};

}  // namespace tamp::components
