#include "tasks/set_up/initial_moduli.hpp"

#include <variant>

#include "components/materials/wave_speed.hpp"

namespace tamp::tasks
{

components::TangentModuli initial_moduli(const SceneMaterial& material)
{
  return std::visit([](const auto& model) { return model.initial_moduli(); }, material.model);
}

double initial_wave_speed(const SceneMaterial& material)
{
  const auto [bulk, shear] = initial_moduli(material);
  return components::wave_speed(bulk, shear, material.density);
}

}  // namespace tamp::tasks
