#include "tools/run/drive/material_point.hpp"

#include "components/kinematics/strain_increment.hpp"

namespace tamp::tools
{

namespace
{

/// The material's answer to a strain increment, in the frame that turns with it.
template <class Model>
std::optional<std::string> update(const Model& model, const SymmetricTensor<3>& strain, MaterialPoint& point)
{
  using State = typename Model::State;
  double plastic_work = 0;
  auto& state = std::any_cast<State&>(point.state);
  point.last_update = {};
  components::MaterialBatch<3, State> batch{.strain_increment = {&strain, 1},
                                            .deformation_gradient = {&point.deformation_gradient, 1},
                                            .old_state = {&state, 1},
                                            .stress = {&point.stress, 1},
                                            .state = {&state, 1},
                                            .bulk_modulus = {&point.bulk_modulus, 1},
                                            .shear_modulus = {&point.shear_modulus, 1},
                                            .plastic_work = {&plastic_work, 1}};
  if (components::keeps_gaps(model)) batch.old_opening = batch.opening = {&point.opening, 1};
  if (const auto failure = components::update(model, batch, point.last_update)) return to_string(failure->fault);
  point.plastic_work += plastic_work * point.volume;
  return std::nullopt;
}

}  // namespace

MaterialPoint fresh_point(const tasks::MaterialModel& material, const Matrix<3>& deformation_gradient)
{
  MaterialPoint point{.deformation_gradient = deformation_gradient};
  std::visit(
      [&]<class Model>(const Model& model) {
        point.state = typename Model::State{};
        update(model, SymmetricTensor<3>::Zero(), point);
        point.last_update = {};
      },
      material);
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
      std::visit([&](const auto& model) { return update(model, step.strain_increment, point); }, material);
  if (!failure && !point.stress.allFinite()) return "stress is not finite";
  return failure;
}

}  // namespace tamp::tools
