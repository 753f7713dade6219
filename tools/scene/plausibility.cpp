#include "tools/scene/plausibility.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>
#include <variant>

#include "tasks/set_up/body_sites.hpp"
#include "tasks/set_up/initial_moduli.hpp"
#include "tools/scene/csv_table.hpp"
#include "tools/scene/file_kind.hpp"

namespace tamp::tools
{

namespace
{

using Warnings = std::vector<std::string>;

/// How a column's numbers look in another unit than its name says; empty where they do not.
std::string likely_mistake(const std::string& name, double greatest)
{
  if (name.ends_with("[Pa]") && greatest < 1e4) return "look like MPa, or like nothing that stops a projectile";
  if (name.ends_with("[-]") && greatest > 1.5) return "look like percent";
  return "";
}

void check_table(const InputFile& input, Warnings& warnings)
{
  if (input.pointer.empty() || input.hash.empty() || file_kind(input.file) != FileKind::text) return;
  for (const auto& [name, greatest] : greatest_of_columns(input.file)) {
    const std::string why = likely_mistake(name, greatest);
    if (why.empty()) continue;
    warnings.push_back(
        fmt::format("{}: {} reaches {:.4g} at most: its numbers {}", input.file.string(), name, greatest, why));
  }
}

void check_material(const CheckedScene& checked, std::size_t m, Warnings& warnings)
{
  const tasks::SceneMaterial& material = checked.scene.materials[m];
  const std::string place = fmt::format("/materials/{}", material.name);
  if (material.density < 1 || material.density > 3e4) {
    warnings.push_back(fmt::format("{}/density: {} kg/m3 is that of no known matter", place, material.density));
  }
  const auto& bodies = checked.scene.bodies;
  const auto is_of_it = [&](const tasks::SceneBody& body) { return body.material == static_cast<int>(m); };
  if (std::none_of(bodies.begin(), bodies.end(), is_of_it)) {
    warnings.push_back(fmt::format("{}: no body is of this material", place));
  }
}

void check_speed(const tasks::SceneBody& body, double fastest_wave, Warnings& warnings)
{
  const double speed = Eigen::Vector3d(body.velocity.data()).norm();
  if (speed <= fastest_wave) return;
  warnings.push_back(
      fmt::format("/bodies/{}/velocity: {:.4g} m/s is faster than the fastest wave in any material, {:.4g} m/s",
                  body.name, speed, fastest_wave));
}

/// The strongest centrifuges that soil is tested in reach some hundred times the acceleration on earth.
void check_gravity(const tasks::Scene& scene, Warnings& warnings)
{
  constexpr double doubtful = 1e4;
  const double gravity = Eigen::Vector3d(scene.gravity.data()).norm();
  if (gravity > doubtful) warnings.push_back(fmt::format("/gravity: {:.4g} m/s2 is that of no test", gravity));
}

/// Splines reach further beyond the ground than other particles do, with a gradient shorter than that of the side of a
/// block beside them, which then pushes the ground ahead of it.
void check_contact(const tasks::Scene& scene, Warnings& warnings)
{
  const bool are_splines =
      components::with_shape<1>(scene.interpolator, 1, [](const auto& shape) { return shape.is_spline; });
  for (std::size_t i = 0; are_splines && i < scene.contacts.size(); ++i) {
    if (scene.contacts[i].normal_of != components::ContactTable::flatter) continue;
    warnings.push_back(
        fmt::format("/contact/{}/normal: with \"flatter\" and splines the sides of a body catch on what it "
                    "slides over; with \"regression\", or the flatter material's name, they do not",
                    i));
  }
}

void check_mass(const tasks::Scene& scene, const tasks::SceneBody& body, Warnings& warnings)
{
  // The volume of many solids that overlap takes too long to find.
  constexpr std::size_t few = 10;
  if (std::visit([](const auto& s) { return s.n_shapes(); }, body.solid) > few) return;
  const components::Volume solid = std::visit([](const auto& s) { return s.volume(); }, body.solid);
  const double error = tasks::particle_volume(scene, body) / solid.value - 1;
  if (std::abs(error) - solid.error / solid.value <= 0.01) return;
  warnings.push_back(
      fmt::format("/bodies/{}/geometry: its particles are off by {:+.3g} % of its mass; finer cells, or more "
                  "particles in each, come closer",
                  body.name, 100 * error));
}

void check_density(const std::string& place, const Json& material, Warnings& warnings)
{
  constexpr double close = 0.05;
  if (!material.contains("tested_density")) return;
  const double density = material["density"].get<double>(), tested = material["tested_density"].get<double>();
  const double difference = density / tested - 1;
  if (std::abs(difference) <= close) return;
  warnings.push_back(fmt::format(
      "{}/density: {:.5g} kg/m3 is {:+.0f} % off the {:.5g} kg/m3 of the samples that were tested; a sand's "
      "stiffness and strength change with its density",
      place, density, 100 * difference, tested));
}

void check_strain(const std::string& place, const Json& material, Warnings& warnings)
{
  if (!material.contains("tested_strain") || material["tested_strain"] == material["strain_measure"]) return;
  const std::string tested = material["tested_strain"], read = material["strain_measure"];
  // A volume ratio is a larger number as logarithmic strain.
  warnings.push_back(fmt::format(
      "{}/strain_measure: strains that were measured as {} ones are read as {}; in compression the material "
      "is then {} than was measured",
      place, tested, read, read == "logarithmic" ? "stiffer" : "softer"));
}

}  // namespace

std::vector<std::string> material_warnings(const CheckedScene& checked)
{
  Warnings warnings;
  for (const auto& [name, material] : checked.resolved.at("materials").items()) {
    const std::string place = "/materials/" + name;
    check_density(place, material, warnings);
    check_strain(place, material, warnings);
  }
  return warnings;
}

std::vector<std::string> plausibility_warnings(const CheckedScene& checked)
{
  const tasks::Scene& scene = checked.scene;
  Warnings warnings;
  for (const InputFile& input : checked.inputs) check_table(input, warnings);
  double fastest_wave = 0;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    check_material(checked, m, warnings);
    fastest_wave = std::max(fastest_wave, tasks::initial_wave_speed(scene.materials[m]));
  }
  check_gravity(scene, warnings);
  check_contact(scene, warnings);
  for (const tasks::SceneBody& body : scene.bodies) {
    check_speed(body, fastest_wave, warnings);
    check_mass(scene, body, warnings);
  }
  return warnings;
}

}  // namespace tamp::tools
