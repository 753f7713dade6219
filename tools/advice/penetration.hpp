#pragma once

#include <Eigen/Core>
#include <optional>

#include "tasks/scene.hpp"

namespace tamp::tools
{

/// The greatest x . direction of a body's points at the start [m].
double reach(const tasks::SceneBody& body, const Eigen::Vector3d& direction);

/// The way that a body's velocity or its drive takes it by the end of the scene, if nothing stops it [m].
Eigen::Vector3d way_of(const tasks::Scene& scene, const tasks::SceneBody& body);

/// The speed of compression waves in a body's unstrained material [m/s].
double waves_in(const tasks::Scene& scene, const tasks::SceneBody& body);

/// Fewest cells to a half width: with fewer the force on a body is a tenth or more too large, see
/// docs/how_to/cells_and_method.md.
inline constexpr double least_cells_per_half_width = 6;

/// Whether no other body is in a body's way.
bool meets_no_other(const tasks::Scene& scene, const tasks::SceneBody& body, const Eigen::Vector3d& way);

/// A body on its way into a softer one of another material.
struct Penetration {
  const tasks::SceneBody* into;
  /// Half of the body's least width across that way, or all of it from a wall on which the body lies: a half or a
  /// quarter of it is simulated [m].
  double half_width;
  double cell_size;

  double cells() const { return half_width / cell_size; }
  bool is_coarse() const;
  /// The largest cells that are small enough, rounded down to two digits [m].
  double fine_cell_size() const;
};

/// The penetration of a body, if it has one: none where it meets no other body, only slides along it, or reaches from
/// wall to wall. If it meets several bodies, that one of them into which it is the thinnest.
std::optional<Penetration> penetration_of(const tasks::Scene& scene, const tasks::SceneBody& body);

}  // namespace tamp::tools
