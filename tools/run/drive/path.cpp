#include "tools/run/drive/path.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>

#include "components/errors.hpp"
#include "components/geometry/rotations.hpp"
#include "components/portable_math.hpp"

namespace tamp::tools
{

namespace
{

using components::BadValue;

/// The least determinant on the straight way from `a` to `b`, det a not 0. With A = a^-1 (b - a) it is that of
/// 1 + s A, a cubic in s of A's invariants, least at an end or where its derivative vanishes.
double least_determinant(const Matrix<3>& a, const Matrix<3>& b)
{
  const Matrix<3> change = a.inverse() * (b - a);
  const double first = change.trace(), third = change.determinant();
  const double second = 0.5 * (first * first - (change * change).trace());
  const auto ratio = [&](double s) { return 1 + s * (first + s * (second + s * third)); };

  double least = std::min(1.0, ratio(1));
  const double discriminant = second * second - 3 * first * third;
  if (discriminant >= 0) {
    const double q = -(second + std::copysign(std::sqrt(discriminant), second));
    for (const double s : {q / (3 * third), first / q}) {
      if (s > 0 && s < 1) least = std::min(least, ratio(s));
    }
  }
  return least * a.determinant();
}

void check_row(const PathRow& row, std::ptrdiff_t i)
{
  const double determinant = row.deformation_gradient.determinant();
  if (!(determinant > 0)) throw BadValue(fmt::format("det F = {}", determinant), "a determinant above 0", i);
  if (row.angle != 0 && !(row.axis.norm() > 0)) throw BadValue("a rotation about the axis 0 0 0", "an axis", i);
}

void check_way(const PathRow& before, const PathRow& row, std::ptrdiff_t i)
{
  if (!(row.time > before.time)) {
    throw BadValue(fmt::format("time {} after {}", row.time, before.time), "times that rise", i);
  }
  const double least = least_determinant(before.deformation_gradient, row.deformation_gradient);
  if (!(least > 0)) {
    throw BadValue(fmt::format("det F falls to {:.6g} on the straight way from the row before", least),
                   "a determinant above 0", i);
  }
  const bool both_turned = before.angle != 0 && row.angle != 0;
  if (both_turned && !row.axis.normalized().isApprox(before.axis.normalized())) {
    throw BadValue("an axis other than that of the row before", "the same one, or an angle of 0 between", i);
  }
}

/// A deformation that does not change at all is left as it is.
bool keeps_volume(const Matrix<3>& from, const Matrix<3>& to)
{
  constexpr double round_off = 1e-9;
  const double before = from.determinant();
  return from != to && std::abs(to.determinant() - before) <= round_off * before;
}

}  // namespace

DeformationPath::DeformationPath(std::vector<PathRow> rows) : rows_(std::move(rows))
{
  if (rows_.size() < 2) throw BadValue(fmt::format("{} rows", rows_.size()), "two or more");
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    check_row(rows_[i], static_cast<std::ptrdiff_t>(i));
    if (i > 0) check_way(rows_[i - 1], rows_[i], static_cast<std::ptrdiff_t>(i));
  }
}

double DeformationPath::time(std::size_t segment, double fraction) const
{
  return std::lerp(rows_[segment].time, rows_[segment + 1].time, fraction);
}

Matrix<3> DeformationPath::unturned(std::size_t segment, double fraction) const
{
  const Matrix<3>&from = rows_[segment].deformation_gradient, &to = rows_[segment + 1].deformation_gradient;
  // Exact at both ends.
  const Matrix<3> straight = (1 - fraction) * from + fraction * to;
  if (fraction == 0 || fraction == 1 || !keeps_volume(from, to)) return straight;
  const double volume = std::lerp(from.determinant(), to.determinant(), fraction);
  return straight * portable::pow(volume / straight.determinant(), 1.0 / 3);
}

Matrix<3> DeformationPath::deformation_gradient(std::size_t segment, double fraction) const
{
  const PathRow &from = rows_[segment], &to = rows_[segment + 1];
  const double angle = std::lerp(from.angle, to.angle, fraction);
  if (angle == 0) return unturned(segment, fraction);
  const Vector<3>& axis = to.angle != 0 ? to.axis : from.axis;
  return components::axis_rotation(axis, angle) * unturned(segment, fraction);
}

}  // namespace tamp::tools
