#include "tools/run/drive/laboratory_test.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp::tools
{

namespace
{

/// Stretches give way to the mean of their normal stresses, all alike.
StressControl normal_control(const std::string& name, const Vector<3>& is_free)
{
  StressControl control{name, SymmetricTensor<3>::Zero(), is_free.asDiagonal()};
  control.weights.head<3>() = is_free / is_free.sum();
  return control;
}

/// The lateral stretches give way to the mean stress.
StressControl mean_control()
{
  StressControl control = normal_control("mean stress", {0, 1, 1});
  control.weights.head<3>().setConstant(1.0 / 3);
  return control;
}

/// The stress at the start along an axis. Where all stresses are equal so are all stretches, to the bit.
StressAtStart along_axis(const LaboratoryTest& test, int axis)
{
  if (test.lateral_ratio == 1) return {{normal_control("mean stress", Vector<3>::Ones())}, {-test.pressure}};
  const Vector<3> axial = Vector<3>::Unit(axis);
  return {{normal_control("axial stress", axial), normal_control("lateral stress", Vector<3>::Ones() - axial)},
          {-test.pressure, -test.lateral_ratio * test.pressure}};
}

StressAtStart along_first_axis(const LaboratoryTest& test)
{
  return along_axis(test, 0);
}

StressAtStart along_second_axis(const LaboratoryTest& test)
{
  return along_axis(test, 1);
}

StressAtStart without_lateral_strain(const LaboratoryTest& test)
{
  return {{component_control(0, 0)}, {-test.pressure}};
}

StressAtStart no_stress(const LaboratoryTest&)
{
  return {};
}

/// Where the ways of the test end, as parts of the whole: 0, 1, or 0, 1, 0, 1, ..., 0.
std::vector<double> turns(const LaboratoryTest& test)
{
  std::vector<double> parts{0, 1};
  for (int i = 2; i <= 2 * test.n_cycles; ++i) parts.push_back(i % 2);
  return parts;
}

/// `deformation(strain)` is that since the start.
template <class Deformation>
DeformationPath deformation_path(const LaboratoryTest& test, const Matrix<3>& start, const Deformation& deformation)
{
  std::vector<PathRow> rows;
  for (const double part : turns(test)) {
    rows.push_back({static_cast<double>(rows.size()), deformation(part * test.strain) * start});
  }
  return DeformationPath(std::move(rows));
}

template <class Deformation>
MixedPath mixed_path(const LaboratoryTest& test, const Matrix<3>& start, const StressControl& control, double stress,
                     const Deformation& deformation)
{
  std::vector<MixedRow> rows;
  for (const double part : turns(test)) {
    rows.push_back({static_cast<double>(rows.size()), deformation(part * test.strain) * start, {stress}});
  }
  return MixedPath({control}, std::move(rows));
}

Matrix<3> axial(double strain)
{
  return Vector<3>(1 - strain, 1, 1).asDiagonal();
}

Matrix<3> axial_undrained(double strain)
{
  const double lateral = 1 / std::sqrt(1 - strain);
  return Vector<3>(1 - strain, lateral, lateral).asDiagonal();
}

Matrix<3> shear(double strain)
{
  Matrix<3> f = Matrix<3>::Identity();
  f(0, 1) = strain;
  return f;
}

LoadPath isotropic_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  std::vector<MixedRow> rows;
  for (const double part : turns(test)) {
    rows.push_back({static_cast<double>(rows.size()), start, {-part * test.pressure}});
  }
  return MixedPath({normal_control("mean stress", Vector<3>::Ones())}, std::move(rows));
}

LoadPath triaxial_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  return mixed_path(test, start, normal_control("lateral stress", {0, 1, 1}), -test.lateral_ratio * test.pressure,
                    axial);
}

LoadPath triaxial_undrained_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  return deformation_path(test, start, axial_undrained);
}

LoadPath oedometer_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  return deformation_path(test, start, axial);
}

LoadPath simple_shear_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  return mixed_path(test, start, component_control(1, 1), -test.pressure, shear);
}

LoadPath simple_shear_undrained_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  return deformation_path(test, start, shear);
}

LoadPath constant_p_path(const LaboratoryTest& test, const Matrix<3>& start)
{
  return mixed_path(test, start, mean_control(), -(1 + 2 * test.lateral_ratio) / 3 * test.pressure, axial);
}

struct TestKind {
  std::string_view name;
  StressAtStart (*start)(const LaboratoryTest& test);
  LoadPath (*path)(const LaboratoryTest& test, const Matrix<3>& start);
};

constexpr std::array<TestKind, 7> test_kinds{{
    {"isotropic", no_stress, isotropic_path},
    {"triaxial", along_first_axis, triaxial_path},
    {"triaxial_undrained", along_first_axis, triaxial_undrained_path},
    {"oedometer", without_lateral_strain, oedometer_path},
    {"simple_shear", along_second_axis, simple_shear_path},
    {"simple_shear_undrained", along_second_axis, simple_shear_undrained_path},
    {"constant_p", along_first_axis, constant_p_path},
}};

const TestKind& kind_of(std::string_view test)
{
  const auto is_named = [test](const TestKind& kind) { return kind.name == test; };
  return *std::find_if(test_kinds.begin(), test_kinds.end(), is_named);
}

}  // namespace

std::vector<std::string> laboratory_test_names()
{
  std::vector<std::string> names;
  names.reserve(test_kinds.size());
  for (const TestKind& kind : test_kinds) names.emplace_back(kind.name);
  return names;
}

bool goes_to_strain(std::string_view test)
{
  return kind_of(test).path != isotropic_path;
}

bool has_lateral_ratio(std::string_view test)
{
  const auto start = kind_of(test).start;
  return start == along_first_axis || start == along_second_axis;
}

StressAtStart stress_at_start(const LaboratoryTest& test)
{
  return kind_of(test.name).start(test);
}

LoadPath path_of(const LaboratoryTest& test, const Matrix<3>& start)
{
  return kind_of(test.name).path(test, start);
}

}  // namespace tamp::tools
