#pragma once

#include <optional>
#include <vector>

#include "components/curves/monotone_cubic.hpp"
#include "components/geometry/axis.hpp"
#include "components/geometry/surface_point.hpp"
#include "components/geometry/volume.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Radius of a body of revolution, `along` its axis [m].
struct ProfilePoint {
  double along;
  double radius;
};

/// The body of revolution through a profile of points. Between them the area of the section, pi r^2, is the cubic that
/// rises and falls only where its points do, so that the body is smooth, a cone's tip is round, and the volume exact.
/// It holds its first end and not its last, and no point at its radius.
class Revolved
{
 public:
  /// `start` is where the profile's `along` is 0, `axis` the direction in which it grows, of any length. Only the ends
  /// of the profile may have radius 0. `tip_radius` is the radius of curvature of the first end, whose radius is then
  /// 0: r^2 grows by 2 `tip_radius` per length there. Throws BadValue, with the row of the profile.
  Revolved(const Vector<3>& start, const Vector<3>& axis, const std::vector<ProfilePoint>& profile,
           std::optional<double> tip_radius = std::nullopt);

  bool contains(const Vector<3>& x) const;
  double reach(const Vector<3>& direction) const;
  void faces(const Vector<3>& x, SurfacePoints<3>& points) const;
  Volume volume() const;

  /// Squared radius at a place between the ends [m^2].
  double radius_squared(double along) const;

 private:
  void round_tip(double tip_radius);
  /// r^2 along the axis, and how it grows.
  CubicValue squared_at(double along) const;
  /// How half the square of the distance from `place` to the outline grows along the axis, times the radius there.
  double growth_of_distance(const Vector<2>& place, double along) const;
  /// Where along the axis the outline is nearest to `place`, in the half plane of both.
  double nearest_along(const Vector<2>& place) const;

  Axis axis_;
  /// Places along the axis, r^2 there and how it grows.
  std::vector<double> along_, squared_, slope_;
  /// Points of the outline, close together.
  std::vector<Vector<2>> outline_;
};

}  // namespace tamp::components
