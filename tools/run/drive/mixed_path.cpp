#include "tools/run/drive/mixed_path.hpp"

#include <fmt/core.h>

#include "components/errors.hpp"

namespace tamp::tools
{

namespace
{

using components::BadValue;

/// Place of a component among those of a symmetric tensor.
constexpr int symmetric_place[3][3] = {{0, 3, 5}, {3, 1, 4}, {5, 4, 2}};

void check_stretches(const MixedRow& row, const Matrix<3>& is_free, std::ptrdiff_t at)
{
  for (int i = 0; i < 3; ++i) {
    const double stretch = row.deformation_gradient(i, i);
    if (is_free(i, i) == 0 && !(stretch > 0)) {
      throw BadValue(fmt::format("F{0}{0} = {1}", i + 1, stretch), "a stretch above 0", at);
    }
  }
}

}  // namespace

StressControl component_control(int i, int j)
{
  StressControl control{fmt::format("S{}{}", i + 1, j + 1), SymmetricTensor<3>::Zero(), Matrix<3>::Zero()};
  control.weights[symmetric_place[i][j]] = 1;
  control.direction(i, j) = 1;
  return control;
}

Matrix<3> free_entries(const std::vector<StressControl>& controls)
{
  Matrix<3> entries = Matrix<3>::Zero();
  for (const StressControl& control : controls) entries += control.direction;
  return entries;
}

Matrix<3> completed(const Matrix<3>& prescribed, const std::vector<StressControl>& controls, const Matrix<3>& unknown)
{
  return (free_entries(controls).array() > 0).select(unknown, prescribed);
}

MixedPath::MixedPath(std::vector<StressControl> controls, std::vector<MixedRow> rows)
    : controls_(std::move(controls)), rows_(std::move(rows))
{
  if (rows_.size() < 2) throw BadValue(fmt::format("{} rows", rows_.size()), "two or more");
  const Matrix<3> is_free = free_entries(controls_);
  for (std::size_t i = 0; i < rows_.size(); ++i) {
    const auto at = static_cast<std::ptrdiff_t>(i);
    check_stretches(rows_[i], is_free, at);
    if (i > 0 && !(rows_[i].time > rows_[i - 1].time)) {
      throw BadValue(fmt::format("time {} after {}", rows_[i].time, rows_[i - 1].time), "times that rise", at);
    }
  }
  const double determinant =
      completed(rows_.front().deformation_gradient, controls_, Matrix<3>::Identity()).determinant();
  if (!(determinant > 0)) throw BadValue(fmt::format("det F = {}", determinant), "a determinant above 0", 0);
}

}  // namespace tamp::tools
