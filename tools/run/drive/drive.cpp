#include "tools/run/drive/drive.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/kinematics/strain_increment.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tools
{

namespace
{

/// rad, in one increment
constexpr double largest_turn = 0.1;

double fraction_of(std::size_t i, std::size_t n)
{
  return static_cast<double>(i) / static_cast<double>(n);
}

/// The largest strain of `n` increments. The superposed rotation is left out: it strains nothing.
double largest_strain_of(const DeformationPath& path, std::size_t segment, std::size_t n)
{
  double largest = 0;
  Matrix<3> from = path.unturned(segment, 0);
  for (std::size_t i = 1; i <= n; ++i) {
    const Matrix<3> to = path.unturned(segment, fraction_of(i, n));
    const auto step = components::strain_increment<3>(from, to * from.inverse() - Matrix<3>::Identity());
    if (!step.admissible()) return std::numeric_limits<double>::infinity();
    largest = std::max(largest, std::sqrt(double_dot(step.strain_increment, step.strain_increment)));
    from = to;
  }
  return largest;
}

/// As few as keep each within the strain allowed.
std::size_t n_for_strain(const DeformationPath& path, std::size_t segment, double allowed)
{
  std::size_t n = 1;
  while (true) {
    // The strain of an increment goes about as the inverse of their number.
    const double excess = largest_strain_of(path, segment, n) / allowed;
    if (excess <= 1) return n;
    n = std::max(n + 1, static_cast<std::size_t>(static_cast<double>(n) * std::min(excess, 2.0)));
  }
}

std::size_t n_for_rotation(const DeformationPath& path, std::size_t segment)
{
  const double turn = std::abs(path.rows()[segment + 1].angle - path.rows()[segment].angle);
  return static_cast<std::size_t>(std::ceil(turn / largest_turn));
}

}  // namespace

void drive(const tasks::SceneMaterial& material, const DeformationPath& path, double largest_strain,
           const std::function<void(double time, const MaterialPoint& point)>& show)
{
  MaterialPoint point = fresh_point(material.model, path.deformation_gradient(0, 0));
  show(path.time(0, 0), point);
  for (std::size_t segment = 0; segment < path.n_segments(); ++segment) {
    const std::size_t n = std::max(n_for_strain(path, segment, largest_strain), n_for_rotation(path, segment));
    for (std::size_t i = 1; i <= n; ++i) {
      const double fraction = fraction_of(i, n), time = path.time(segment, fraction);
      const auto failure = deform(material.model, path.deformation_gradient(segment, fraction), point);
      if (failure) {
        throw tasks::SimulationError(
            fmt::format("{}: at {} s, on the way to row {} of the path", *failure, time, segment + 2), material.name,
            -1, {});
      }
      show(time, point);
    }
  }
}

}  // namespace tamp::tools
