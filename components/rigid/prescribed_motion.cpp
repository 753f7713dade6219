#include "components/rigid/prescribed_motion.hpp"

#include <algorithm>
#include <limits>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

namespace
{

constexpr double forever = std::numeric_limits<double>::infinity();

void check(const std::vector<PrescribedMotion::Point>& points, std::size_t least)
{
  if (points.size() < least) {
    throw BadValue(std::to_string(points.size()) + " points", std::to_string(least) + " or more");
  }
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].time > points[i - 1].time) continue;
    throw BadValue(std::to_string(points[i].time) + " s after " + std::to_string(points[i - 1].time) + " s",
                   "times that ascend");
  }
}

}  // namespace

Vector<3> PrescribedMotion::Piece::velocity(double time) const
{
  if (first == last) return first;
  return first + (time - begin) / (end - begin) * (last - first);
}

PrescribedMotion PrescribedMotion::of_velocities(const std::vector<Point>& points)
{
  check(points, 1);
  std::vector<Piece> pieces{{-forever, points.front().time, points.front().value, points.front().value}};
  for (std::size_t i = 1; i < points.size(); ++i) {
    pieces.push_back({points[i - 1].time, points[i].time, points[i - 1].value, points[i].value});
  }
  pieces.push_back({points.back().time, forever, points.back().value, points.back().value});
  return PrescribedMotion(std::move(pieces));
}

PrescribedMotion PrescribedMotion::of_displacements(const std::vector<Point>& points)
{
  check(points, 2);
  if (points.front().value != Vector<3>::Zero())
    throw BadValue("a first displacement that is not 0", "the body to start where it is");
  const Vector<3> rest = Vector<3>::Zero();
  std::vector<Piece> pieces{{-forever, points.front().time, rest, rest}};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const Point &from = points[i - 1], &to = points[i];
    const Vector<3> velocity = (to.value - from.value) / (to.time - from.time);
    pieces.push_back({from.time, to.time, velocity, velocity});
  }
  pieces.push_back({points.back().time, forever, rest, rest});
  return PrescribedMotion(std::move(pieces));
}

Vector<3> PrescribedMotion::way(double from, double to) const
{
  Vector<3> sum = Vector<3>::Zero();
  for (const Piece& piece : pieces_) {
    const double begin = std::max(from, piece.begin), end = std::min(to, piece.end);
    if (end > begin) sum += (end - begin) * 0.5 * (piece.velocity(begin) + piece.velocity(end));
  }
  return sum;
}

Vector<3> PrescribedMotion::velocity(double time) const
{
  const auto piece = std::find_if(pieces_.begin(), pieces_.end(), [&](const Piece& p) { return time < p.end; });
  return piece->velocity(time);
}

bool PrescribedMotion::has_part_along(int axis) const
{
  return std::any_of(pieces_.begin(), pieces_.end(),
                     [&](const Piece& p) { return p.first[axis] != 0 || p.last[axis] != 0; });
}

}  // namespace tamp::components
