#pragma once

#include <array>
#include <string_view>

#include "components/boundary/face.hpp"
#include "components/parameter.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// A wall with Coulomb's friction. Motion into it is stopped, and motion along it loses at most friction times as much;
/// a node that leaves the wall is free.
struct RoughWall {
  static constexpr std::string_view word = "friction", shown = R"({"friction": MU, "at_edges": true})",
                                    meaning =
                                        "a wall with friction, which matter may leave; not where a centrifuge turns "
                                        "the grid; without `at_edges` matter touches it already a cell away";
  constexpr FaceTraits traits() const { return {.keeps_push = true, .at_edges = at_edges}; }
  static constexpr std::array<Parameter<RoughWall>, 2> parameters();
  friend bool operator==(const RoughWall&, const RoughWall&) = default;

  double friction = 0;
  bool at_edges = false;

  template <int D>
  Vector<D> velocity(const Vector<D>& arriving, const WallNode& node) const
  {
    return left_by_friction<D>(arriving, node, friction);
  }
  /// Friction has worked on the velocities that particles bring.
  template <int D>
  Vector<D> carried_velocity(const Vector<D>& arriving, const WallNode& node) const
  {
    return left_by_friction<D>(arriving, node, 0);
  }

 private:
  template <int D>
  static Vector<D> left_by_friction(const Vector<D>& velocity, const WallNode& node, double friction)
  {
    const double approach = node.outside * velocity[node.axis];
    if (!(approach > 0)) return velocity;
    Vector<D> along = velocity;
    along[node.axis] = 0;
    const double speed = along.norm();
    if (speed <= friction * approach) return Vector<D>::Zero();
    return (1 - friction * approach / speed) * along;
  }
};

constexpr std::array<Parameter<RoughWall>, 2> RoughWall::parameters()
{
  return {{{"friction", "", zero_or_above, &RoughWall::friction, "Coulomb's coefficient of friction"},
           {"at_edges",
            "",
            {},
            &RoughWall::at_edges,
            "whether matter touches the wall where the edges of its particles do",
            true}}};
}

}  // namespace tamp::components
