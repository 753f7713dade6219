#include "tools/run/drive/increments.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/kinematics/strain_increment.hpp"

namespace tamp::tools
{

namespace
{

/// rad, in one increment
constexpr double largest_turn = 0.1;

/// The largest strain of `n` increments. The superposed rotation is left out: it strains nothing.
double largest_strain_of(const DeformationPath& path, std::size_t segment, std::size_t n)
{
  double largest = 0;
  Matrix<3> from = path.unturned(segment, 0);
  for (std::size_t i = 1; i <= n; ++i) {
    const Matrix<3> to = path.unturned(segment, static_cast<double>(i) / static_cast<double>(n));
    largest = std::max(largest, strain_between(from, to));
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

double strain_between(const Matrix<3>& from, const Matrix<3>& to)
{
  const auto step = components::strain_increment<3>(from, to * from.inverse() - Matrix<3>::Identity());
  if (!step.admissible()) return std::numeric_limits<double>::infinity();
  return std::sqrt(double_dot(step.strain_increment, step.strain_increment));
}

std::size_t n_increments(const DeformationPath& path, std::size_t segment, double largest_strain)
{
  return std::max(n_for_strain(path, segment, largest_strain), n_for_rotation(path, segment));
}

}  // namespace tamp::tools
