#pragma once

#include <string>
#include <variant>
#include <vector>

#include "components/tensors.hpp"
#include "tools/run/drive/path.hpp"

namespace tamp::tools
{

/// A number of the Cauchy stress that is prescribed, and the entries of the deformation gradient that give way to it.
struct StressControl {
  std::string name;            ///< for messages, such as S22
  SymmetricTensor<3> weights;  ///< the number is the sum of the stress's components times these
  Matrix<3> direction;         ///< 1 at the entries that give way, all by the same change, and 0 elsewhere

  /// Pa, tension positive.
  double stress_of(const SymmetricTensor<3>& stress) const { return weights.dot(stress); }
};

/// The component of axes i <= j, from 0 to 2, to which F_ij gives way; called S12 for 0 and 1.
StressControl component_control(int i, int j);

/// 1 at the entries that give way to any of the controls.
Matrix<3> free_entries(const std::vector<StressControl>& controls);

/// A prescribed deformation with the entries of `unknown` where it gives way to stress.
Matrix<3> completed(const Matrix<3>& prescribed, const std::vector<StressControl>& controls, const Matrix<3>& unknown);

struct MixedRow {
  double time;                     ///< s
  Matrix<3> deformation_gradient;  ///< entries that give way to stress are not read
  std::vector<double> stress;      ///< of each control [Pa], tension positive
};

/// Deformation prescribed in part, and stress in place of the rest. Between rows both go linearly in time.
class MixedPath
{
 public:
  /// Throws BadValue, with the row, unless there are two or more, times rise, prescribed stretches are above 0, and the
  /// first deformation has a determinant above 0 where what gives way is as in the identity.
  MixedPath(std::vector<StressControl> controls, std::vector<MixedRow> rows);

  const std::vector<StressControl>& controls() const { return controls_; }
  const std::vector<MixedRow>& rows() const { return rows_; }

 private:
  std::vector<StressControl> controls_;
  std::vector<MixedRow> rows_;
};

using LoadPath = std::variant<DeformationPath, MixedPath>;

}  // namespace tamp::tools
