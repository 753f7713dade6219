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
  if (tip_radius) round_tip(*tip_radius);
  constexpr int n_between = 16;
  for (std::size_t i = 0; i + 1 < along_.size(); ++i) {
    for (int k = i == 0 ? 0 : 1; k <= n_between; ++k) {
      const double along = k == n_between ? along_[i + 1] : along_[i] + k * (along_[i + 1] - along_[i]) / n_between;
      outline_.emplace_back(along, std::sqrt(std::max(radius_squared(along), 0.0)));
    }
  }
}

void Revolved::round_tip(double tip_radius)
{
  require_positive(tip_radius, "tip radius");
  // A cubic that starts more than three times as steep as its chord does not stay monotone.
  const double steepest = 3 * (squared_[1] - squared_[0]) / (along_[1] - along_[0]);
  if (squared_[0] != 0 || 2 * tip_radius > steepest) {
    throw BadValue(
        "tip radius " + std::to_string(tip_radius) + " at a radius of " + std::to_string(std::sqrt(squared_[0])),
        "at most " + std::to_string(steepest / 2) + ", on a profile that starts at radius 0", 0);
  }
  slope_[0] = 2 * tip_radius;
}

CubicValue Revolved::squared_at(double along) const
{
  const auto next = std::upper_bound(along_.begin() + 1, along_.end() - 1, along) - along_.begin();
  const auto i = static_cast<std::size_t>(next) - 1;
  return cubic(along_[i + 1] - along_[i], squared_[i], slope_[i], squared_[i + 1], slope_[i + 1], along - along_[i]);
}

double Revolved::radius_squared(double along) const
{
  return squared_at(along).value;
}

double Revolved::growth_of_distance(const Vector<2>& place, double along) const
{
  const auto [squared, slope] = squared_at(along);
  const double radius = std::sqrt(std::max(squared, 0.0));
  if (radius == 0 && place[1] == 0) return along - place[0] + slope / 2;
  return (along - place[0]) * radius + slope / 2 * (radius - place[1]);
}

double Revolved::nearest_along(const Vector<2>& place) const
{
  const auto nearest = std::min_element(outline_.begin(), outline_.end(), [&](const Vector<2>& a, const Vector<2>& b) {
    return (a - place).squaredNorm() < (b - place).squaredNorm();
  });
  double low = (nearest == outline_.begin() ? *nearest : *(nearest - 1))[0];
  double high = (nearest + 1 == outline_.end() ? *nearest : *(nearest + 1))[0];
  double at_low = growth_of_distance(place, low), at_high = growth_of_distance(place, high);
  if (at_low >= 0) return low;
  if (at_high <= 0) return high;
  // By false position, where an end that stays counts half each time (Dowell and Jarratt 1971).
  constexpr int most = 100;
  double along = low;
  for (int i = 0; i < most; ++i) {
    const double before = along;
    along = (low * at_high - high * at_low) / (at_high - at_low);
    if (std::abs(along - before) <= 1e-15 * (along_.back() - along_.front())) break;
    const double here = growth_of_distance(place, along);
    if (here == 0) break;
    const bool is_low = here < 0, was_low = before == low;
    if (is_low == was_low && i > 0) (is_low ? at_high : at_low) *= 0.5;
    (is_low ? low : high) = along;
    (is_low ? at_low : at_high) = here;
  }
  return along;
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

void Revolved::faces(const Vector<3>& x, SurfacePoints<3>& points) const
{
  const MeridianPlane plane = axis_.plane_of(x);
  const double along = nearest_along(plane.place);
  const auto [squared, slope] = squared_at(along);
  const Vector<2> at(along, std::sqrt(std::max(squared, 0.0)));
  const Vector<2> steep(-slope / 2, at[1]), forward(along == along_.front() ? -1 : 1, 0);
  points.push_back(plane.in_space({at, steep.norm() > 0 ? Vector<2>(steep.normalized()) : forward}));
  const Vector<2>&first = outline_.front(), &last = outline_.back();
  if (first[1] > 0) points.push_back(plane.in_space(nearest_of_edge(first, {first[0], 0}, plane.place)));
  if (last[1] > 0) points.push_back(plane.in_space(nearest_of_edge({last[0], 0}, last, plane.place)));
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
