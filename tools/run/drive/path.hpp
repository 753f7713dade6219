#pragma once

#include <vector>

#include "components/tensors.hpp"

namespace tamp::tools
{

/// A prescribed deformation at one time: a deformation gradient, and a rotation superposed on it from the left.
struct PathRow {
  double time;  ///< s
  Matrix<3> deformation_gradient;
  double angle = 0;                   ///< of the superposed rotation, rad
  Vector<3> axis{Vector<3>::Zero()};  ///< of any length; not read where the angle is 0
};

/// A deformation prescribed at two or more times. Between them angle and deformation gradient go linearly in time;
/// where det F is the same in both rows, to 1e-9, it is kept on the way too: the linear F times the cube root of what
/// its determinant lacks, so that an undrained path is one between its rows as well. Exact at every row.
class DeformationPath
{
 public:
  /// Throws BadValue, with the row, unless times rise, no deformation turns inside out at a row or on the way to it,
  /// and every rotation has an axis, the same one in neighbouring rows that are both turned.
  explicit DeformationPath(std::vector<PathRow> rows);

  const std::vector<PathRow>& rows() const { return rows_; }
  /// A segment goes from the row of its number to the next.
  std::size_t n_segments() const { return rows_.size() - 1; }

  /// Time at a fraction of a segment, from 0 to 1.
  double time(std::size_t segment, double fraction) const;
  /// F without the superposed rotation.
  Matrix<3> unturned(std::size_t segment, double fraction) const;
  /// F with the superposed rotation: R(angle, axis) F.
  Matrix<3> deformation_gradient(std::size_t segment, double fraction) const;

 private:
  std::vector<PathRow> rows_;
};

}  // namespace tamp::tools
