#include "tools/drive/material_point.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/kinematics/strain_increment.hpp"

namespace tamp::tools
{

namespace
{

using components::Hypoelastic;
using components::NeoHookean;
using components::TabularCap;

std::optional<std::string> answer(const Hypoelastic& solid, const SymmetricTensor<3>& strain, MaterialPoint& point)
{
  components::update<3>(solid, {&strain, 1}, {&point.stress, 1});
  return std::nullopt;
}

std::optional<std::string> answer(const NeoHookean& solid, const SymmetricTensor<3>&, MaterialPoint& point)
{
  components::update<3>(solid, {&point.deformation_gradient, 1}, {&point.stress, 1});
  const auto moduli = components::tangent_moduli<3>(solid, point.deformation_gradient);
  point.bulk_modulus = moduli.bulk_modulus;
  point.shear_modulus = moduli.shear_modulus;
  return std::nullopt;
}

std::optional<std::string> answer(const TabularCap& sand, const SymmetricTensor<3>& strain, MaterialPoint& point)
{
  double plastic_work = 0;
  point.last_update = {};
  const auto failure =
      components::update<3>(sand, {&strain, 1}, {&point.state, 1}, {&point.stress, 1}, {&point.state, 1},
                            {&point.bulk_modulus, 1}, {&plastic_work, 1}, point.last_update);
  if (failure) return to_string(failure->fault);
  point.shear_modulus = sand.shear_ratio() * point.bulk_modulus;
  point.plastic_work += plastic_work * point.volume;
  return std::nullopt;
}

}  // namespace

double MaterialPoint::sqrt_j2() const
{
  const SymmetricTensor<3> s = deviator(stress);
  return std::sqrt(0.5 * double_dot(s, s));
}

double MaterialPoint::equivalent_stress() const
{
  return std::numbers::sqrt3 * sqrt_j2();
}

MaterialPoint fresh_point(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient)
{
  MaterialPoint point{.deformation_gradient = deformation_gradient};
  if (const auto* sand = std::get_if<TabularCap>(&material)) {
    point.bulk_modulus = sand->initial_bulk_modulus();
    point.shear_modulus = sand->initial_shear_modulus();
  } else if (const auto* elastic = std::get_if<NeoHookean>(&material)) {
    // Its stress is that of its deformation, wherever it starts.
    answer(*elastic, SymmetricTensor<3>::Zero(), point);
  } else {
    const auto& solid = std::get<Hypoelastic>(material);
    point.bulk_modulus = solid.bulk_modulus;
    point.shear_modulus = solid.shear_modulus;
  }
  return point;
}

std::optional<std::string> deform(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient,
                                  MaterialPoint& point)
{
  const Matrix<3> g = deformation_gradient * point.deformation_gradient.inverse() - Matrix<3>::Identity();
  const auto step = components::strain_increment<3>(point.deformation_gradient, g);
  if (!step.admissible()) return "the point is turned inside out";
  point.deformation_gradient = deformation_gradient;
  point.volume *= step.volume_ratio;
  point.stress = rotated<3>(point.stress, step.rotation_increment);
  const auto failure =
      std::visit([&](const auto& model) { return answer(model, step.strain_increment, point); }, material);
  if (!failure && !point.stress.allFinite()) return "stress is not finite";
  return failure;
}

double outside(const TabularCap& sand, const MaterialPoint& point)
{
  const components::YieldSurface& surface = sand.parameters().yield;
  const double p = point.pressure(), vertex = surface.vertex_pressure();
  const double crush = sand.crush_pressure(point.state.plastic_volumetric);
  const double beyond = std::max({point.sqrt_j2() - surface.limit(p, crush), p - crush, vertex - p, 0.0});
  return beyond / (crush - vertex);
}

}  // namespace tamp::tools
