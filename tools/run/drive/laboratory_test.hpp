#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "tools/run/drive/mixed_path.hpp"

namespace tamp::tools
{

/// A test of the soil laboratory. Axis 1 is the axial one, 2 and 3 are lateral; in simple shear axis 2 is the axial
/// one, and F12 shears. Stresses are effective ones: undrained means at constant volume.
struct LaboratoryTest {
  std::string name;  ///< one of laboratory_test_names()
  /// Axial stress at the start [Pa], compression positive; of `isotropic` the pressure at the end.
  double pressure = 100e3;
  double lateral_ratio = 1;  ///< K0: lateral over axial stress at the start
  /// Change of length, or shear displacement, at the end, over the length or height at the start; compression positive.
  double strain = 0.2;
  int n_cycles = 0;  ///< ways to the end and back to the start; 0: only the way to the end
};

std::vector<std::string> laboratory_test_names();
/// Whether the test is made to a strain, and whether its lateral stress at the start may be chosen.
bool goes_to_strain(std::string_view test);
bool has_lateral_ratio(std::string_view test);

/// The stress that a test starts from, and what gives way on the straight way there from no stress.
struct StressAtStart {
  std::vector<StressControl> controls;
  std::vector<double> stress;  ///< of each control [Pa], tension positive
};
StressAtStart stress_at_start(const LaboratoryTest& test);

/// The test of a point that has the deformation gradient `start` at its beginning. A way takes 1 s.
LoadPath path_of(const LaboratoryTest& test, const Matrix<3>& start);

}  // namespace tamp::tools
