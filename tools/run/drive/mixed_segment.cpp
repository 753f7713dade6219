#include "tools/run/drive/mixed_segment.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "tools/run/drive/increments.hpp"
#include "tools/run/drive/stress_control.hpp"

namespace tamp::tools
{

namespace
{

/// The least part of a segment that is tried as an increment.
constexpr double least_part = 1e-9;
/// Tries without a stress after which a segment is given up, however far apart they are.
constexpr int most_failures = 3000;

/// Both ends are exact.
MixedTarget target_at(const MixedSegment& segment, double fraction)
{
  const auto between = [fraction](const auto& from, const auto& to) { return (1 - fraction) * from + fraction * to; };
  MixedTarget target{segment.controls, between(segment.from.deformation_gradient, segment.to.deformation_gradient), {}};
  for (std::size_t k = 0; k < segment.controls.size(); ++k) {
    target.stress.push_back(between(segment.from.stress[k], segment.to.stress[k]));
  }
  return target;
}

/// Names the stress that is farthest from where it should go.
std::string not_followed(const MixedSegment& segment, const MaterialPoint& point)
{
  const auto missing = [&](std::size_t k) {
    return std::abs(segment.to.stress[k] - segment.controls[k].stress_of(point.stress));
  };
  std::size_t worst = 0;
  for (std::size_t k = 1; k < segment.controls.size(); ++k) {
    if (missing(k) > missing(worst)) worst = k;
  }
  const StressControl& control = segment.controls[worst];
  return fmt::format("the material cannot follow: {} is {:.6g} Pa, and should be {:.6g} Pa at the end", control.name,
                     control.stress_of(point.stress), segment.to.stress[worst]);
}

}  // namespace

void follow(const Course& course, const MixedSegment& segment, MaterialPoint& point)
{
  const auto time = [&](double fraction) { return std::lerp(segment.from.time, segment.to.time, fraction); };
  double done = 0, part = 1;
  int n_failures = 0;
  while (done < 1) {
    const double end = std::min(1.0, done + part);
    MaterialPoint next = point;
    const bool is_found = deform_to_stress(course.material.model, target_at(segment, end), course.largest_strain, next);
    const double strain = strain_between(point.deformation_gradient, next.deformation_gradient);
    if (!is_found) ++n_failures;
    if (!is_found || strain > course.largest_strain) {
      part /= 2;
      if (part < least_part || n_failures > most_failures) {
        throw course.error(not_followed(segment, point), time(done), segment.row);
      }
      continue;
    }
    point = std::move(next);
    done = end;
    course.show(time(done), point);
    if (strain < course.largest_strain / 2) part *= 2;
  }
}

}  // namespace tamp::tools
