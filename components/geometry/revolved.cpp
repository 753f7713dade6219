#include "components/geometry/revolved.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "components/curves/monotone_cubic.hpp"
#include "components/errors.hpp"
#include "components/geometry/checks.hpp"

namespace tamp::components
{

namespace
{

void check(const std::vector<ProfilePoint>& profile)
{
  if (profile.size() < 2) throw BadValue("a profile of " + std::to_string(profile.size()) + " points", "2 or more");
  for (std::size_t i = 0; i < profile.size(); ++i) {
    const auto row = static_cast<std::ptrdiff_t>(i);
    const ProfilePoint& p = profile[i];
    const bool is_end = i == 0 || i + 1 == profile.size();
    if (!std::isfinite(p.along) || !std::isfinite(p.radius) || p.radius < 0 || (p.radius == 0 && !is_end)) {
      throw BadValue("radius " + std::to_string(p.radius) + " at " + std::to_string(p.along),
                     "a radius above 0, or 0 at an end", row);
    }
    if (i > 0 && !(p.along > profile[i - 1].along)) {
      throw BadValue(
          "a profile that goes from " + std::to_string(profile[i - 1].along) + " to " + std::to_string(p.along),
          "places that grow from row to row", row);
    }
  }
  if (profile.size() == 2 && profile[0].radius + profile[1].radius == 0) {
    throw BadValue("a profile of radius 0", "a radius above 0");
  }
}

}  // namespace

Revolved::Revolved(const Vector<3>& start, const Vector<3>& axis, const std::vector<ProfilePoint>& profile,
                   std::optional<double> tip_radius)
    : axis_{start, axis.normalized()}
{
  require_finite<3>(start, "start");
  require_finite<3>(axis, "axis");
  require_positive(axis.norm(), "length of the axis");
  check(profile);
  for (const ProfilePoint& p : profile) {
    along_.push_back(p.along);
    squared_.push_back(p.radius * p.radius);
  }
  slope_ = monotone_slopes(along_, squared_);
  if (!tip_radius) return;

  require_positive(*tip_radius, "tip radius");
  // A cubic that starts more than three times as steep as its chord does not stay monotone.
  const double steepest = 3 * (squared_[1] - squared_[0]) / (along_[1] - along_[0]);
  if (profile[0].radius != 0 || 2 * *tip_radius > steepest) {
    throw BadValue("tip radius " + std::to_string(*tip_radius) + " at a radius of " + std::to_string(profile[0].radius),
                   "at most " + std::to_string(steepest / 2) + ", on a profile that starts at radius 0", 0);
  }
  slope_[0] = 2 * *tip_radius;
}

double Revolved::radius_squared(double along) const
{
  const auto next = std::upper_bound(along_.begin() + 1, along_.end() - 1, along) - along_.begin();
  const auto i = static_cast<std::size_t>(next) - 1;
  return cubic(along_[i + 1] - along_[i], squared_[i], slope_[i], squared_[i + 1], slope_[i + 1], along - along_[i])
      .value;
}

bool Revolved::contains(const Vector<3>& x) const
{
  const AxialPoint p = axis_.of(x);
  return p.along >= along_.front() && p.along < along_.back() && p.radius_squared < radius_squared(p.along);
}

double Revolved::reach(const Vector<3>& direction) const
{
  // Between two points the radius is monotone, so that a slice lies within its ends' greater radius.
  constexpr int n_slices = 128;
  const double slant = axis_.direction.dot(direction);
  double furthest = -std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i + 1 < along_.size(); ++i) {
    const double thickness = (along_[i + 1] - along_[i]) / n_slices;
    for (int k = 0; k < n_slices; ++k) {
      const double from = along_[i] + k * thickness, to = from + thickness;
      const double radius = std::sqrt(std::max({radius_squared(from), radius_squared(to), 0.0}));
      furthest = std::max(furthest, axis_.rim_reach(slant > 0 ? to : from, radius, direction));
    }
  }
  return furthest;
}

Volume Revolved::volume() const
{
  double sum = 0;
  for (std::size_t i = 0; i + 1 < along_.size(); ++i) {
    const double h = along_[i + 1] - along_[i];
    sum += h * (squared_[i] + squared_[i + 1]) / 2 + h * h * (slope_[i] - slope_[i + 1]) / 12;
  }
  return {std::numbers::pi * sum};
}

}  // namespace tamp::components
