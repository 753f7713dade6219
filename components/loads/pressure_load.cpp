#include "components/loads/pressure_load.hpp"

#include <algorithm>
#include <cstddef>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

PressureCurve::PressureCurve(std::vector<Point> points) : points_(std::move(points))
{
  if (points_.empty()) throw BadValue("no point", "one or more");
  for (std::size_t i = 0; i < points_.size(); ++i) {
    const auto row = static_cast<std::ptrdiff_t>(i);
    const auto [time, pressure] = points_[i];
    if (!(pressure >= 0)) throw BadValue(std::to_string(pressure) + " Pa", "a pressure of 0 or above", row);
    if (i == 0 || time > points_[i - 1].time) continue;
    throw BadValue(std::to_string(time) + " s after " + std::to_string(points_[i - 1].time) + " s", "times that ascend",
                   row);
  }
}

double PressureCurve::at(double time) const
{
  const auto next = std::find_if(points_.begin(), points_.end(), [&](const Point& p) { return time < p.time; });
  if (next == points_.begin()) return points_.front().pressure;
  const Point& before = *(next - 1);
  if (next == points_.end()) return before.pressure;
  return before.pressure + (time - before.time) / (next->time - before.time) * (next->pressure - before.pressure);
}

template <int D>
ByFace<D> PressedBox<D>::part_of(const Vector<D>& centre, double size, double depth) const
{
  const auto overlap = [&](int axis, double longer_below, double longer_above) {
    const double from = std::max(lower[axis] - longer_below, centre[axis] - 0.5 * size);
    const double to = std::min(upper[axis] + longer_above, centre[axis] + 0.5 * size);
    return std::clamp((to - from) / size, 0.0, 1.0);
  };
  ByFace<D> part;
  for (int k = 0; k < D; ++k) {
    part.row(k) << overlap(k, 0, depth), overlap(k, depth, 0);
    for (int other = 0; other < D; ++other) {
      if (other != k) part.row(k) *= overlap(other, 0, 0);
    }
  }
  return part;
}

template struct PressedBox<2>;
template struct PressedBox<3>;

}  // namespace tamp::components
