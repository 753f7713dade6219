#include "tasks/initial_moduli.hpp"

#include <variant>

#include "components/materials/wave_speed.hpp"

namespace tamp::tasks
{

namespace
{

template <class Elastic>
components::TangentModuli moduli_of(const Elastic& solid)
{
  return {solid.bulk_modulus, solid.shear_modulus};
}

components::TangentModuli moduli_of(const components::TabularCap& sand)
{
  return {sand.initial_bulk_modulus(), sand.initial_shear_modulus()};
}

}  // namespace

components::TangentModuli initial_moduli(const SceneMaterial& material)
{
  return std::visit([](const auto& model) { return moduli_of(model); }, material.model);
}

double initial_wave_speed(const SceneMaterial& material)
{
  const auto [bulk, shear] = initial_moduli(material);
  return components::wave_speed(bulk, shear, material.density);
}

}  // namespace tamp::tasks
