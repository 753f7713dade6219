#include "tools/advice/plausibility.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <variant>

#include "tasks/set_up/body_sites.hpp"
#include "tasks/set_up/initial_moduli.hpp"
#include "tasks/set_up/settled_ground.hpp"
#include "tools/advice/penetration.hpp"
#include "tools/scene/files/file_kind.hpp"
#include "tools/scene/tables/csv_table.hpp"

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

/// Soil in the units of other programs: kPa, radians and t/m3. Hardly any soil is below these bounds.
template <components::Soil Model>
void check_soil(const std::string& place, double density, const Model& soil, Warnings& warnings)
{
  constexpr double lightest = 200, softest = 1e5, flattest = 2;
  const auto warn = [&](const auto& key, double value, const auto& unit, const char* what) {
    warnings.push_back(fmt::format("{}/{}: {:.4g} {} looks like {}", place, key, value, unit, what));
  };
  if (density >= 1 && density < lightest) warn("density", density, "kg/m3", "t/m3");
  if constexpr (components::has_parameters<Model>) {
    for (const auto& parameter : Model::parameters()) {
      const auto* member = std::get_if<double Model::*>(&parameter.value);
      const double value = member != nullptr ? soil.**member : 0;
      const bool is_modulus = parameter.key.ends_with("modulus"), is_friction = parameter.key == "friction_angle";
      if (is_modulus && value < softest) warn(parameter.key, value, parameter.unit, "kPa or MPa");
      if (is_friction && value > 0 && value < flattest) warn(parameter.key, value, parameter.unit, "radians");
    }
  }
}

void check_material(const CheckedScene& checked, std::size_t m, Warnings& warnings)
{
  const tasks::SceneMaterial& material = checked.scene.materials[m];
  const std::string place = fmt::format("/materials/{}", material.name);
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (components::Soil<Model>) check_soil(place, material.density, model, warnings);
      },
      material.model);
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

void check_multiplier(const tasks::Scene& scene, Warnings& warnings)
{
  if (scene.time.multiplier <= 1) return;
  warnings.push_back(
      fmt::format("/time/multiplier: steps of {:.4g} times the bound are longer than is known to be stable",
                  scene.time.multiplier));
}

/// Splines reach further beyond the ground than other particles do, with a gradient shorter than that of the side of a
/// block beside them, which then pushes the ground ahead of it.
void check_contact(const tasks::Scene& scene, Warnings& warnings)
{
  const bool are_splines =
      components::with_shape<1>(scene.interpolator, 1, [](const auto& shape) { return shape.is_spline; });
  for (std::size_t i = 0; are_splines && i < scene.contacts.size(); ++i) {
    const tasks::SceneContact& contact = scene.contacts[i];
    const bool is_flatter = std::holds_alternative<components::FlatterNormal>(contact.normal);
    if (!is_flatter || tasks::are_strata(scene, contact.material_a, contact.material_b)) continue;
    warnings.push_back(
        fmt::format("/contact/{}/normal: with \"flatter\" and splines the sides of a body catch on what it "
                    "slides over; with \"regression\", or the flatter material's name, they do not",
                    i));
  }
}

/// A pressure from one moment on strains the outermost particles in the first step by about its part of their
/// stiffness: no bound on that step knows the load.
void check_pressure(const tasks::Scene& scene, const tasks::SceneBody& body, Warnings& warnings)
{
  if (!body.pressure) return;
  const tasks::SceneMaterial& material = scene.materials[static_cast<std::size_t>(body.material)];
  const auto [K, G] = tasks::initial_moduli(material);
  const double pressure = body.pressure->curve.at(0), stiffness = K + 4 * G / 3;
  if (pressure <= 0.2 * stiffness) return;
  warnings.push_back(fmt::format(
      "/bodies/{}/pressure: {:.4g} Pa from the start is {:.2g} times the stiffness of {}, {:.4g} Pa, and may "
      "turn particles inside out in the first step; let it rise from 0",
      body.name, pressure, pressure / stiffness, material.name, stiffness));
}

/// How far the foremost particle of a body ends behind the body's tip [m].
template <int D>
double behind_tip(const tasks::Scene& scene, const tasks::SceneBody& body, const Vector<D>& direction)
{
  const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  double foremost = -std::numeric_limits<double>::infinity();
  for (const Vector<D>& site : tasks::sites_of<D>(scene, body)) foremost = std::max(foremost, site.dot(direction));
  const double ends = foremost + 0.5 * spacing * direction.cwiseAbs().sum();
  return std::get<components::Solid<D>>(body.solid).reach(direction) - ends;
}

bool is_met_by_its_solid(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  return std::any_of(scene.contacts.begin(), scene.contacts.end(), [&](const tasks::SceneContact& contact) {
    return std::holds_alternative<components::SolidNormal>(contact.normal) &&
           (contact.material_a == body.material || contact.material_b == body.material);
  });
}

void check_tip(const tasks::Scene& scene, const tasks::SceneBody& body, Warnings& warnings)
{
  if (is_met_by_its_solid(scene, body)) return;
  const Eigen::Vector3d way = way_of(scene, body);
  if (!(way.norm() > 0)) return;
  const Eigen::Vector3d direction = way.normalized();
  const double behind = scene.grid.dimension == 2 ? behind_tip<2>(scene, body, direction.head<2>().normalized())
                                                  : behind_tip<3>(scene, body, direction);
  const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  if (behind <= 0.5 * spacing) return;
  warnings.push_back(fmt::format(
      "/bodies/{}/geometry: its foremost particle ends {:.2g} m behind its tip, and meets what lies before it "
      "that much later; finer cells, or more particles in each, come closer",
      body.name, behind));
}

void check_approach(const tasks::Scene& scene, Warnings& warnings)
{
  for (std::size_t i = 0; i < scene.contacts.size(); ++i) {
    const tasks::SceneContact& contact = scene.contacts[i];
    if (!components::acts_apart(contact.normal)) continue;
    const bool moves = std::any_of(scene.bodies.begin(), scene.bodies.end(), [&](const tasks::SceneBody& body) {
      return (body.material == contact.material_a || body.material == contact.material_b) &&
             way_of(scene, body).norm() > 0;
    });
    if (!moves) continue;
    const auto beyond = [&](int material) {
      return scene.reach_of(material) - 0.5 / scene.particles_per_axis_of(material);
    };
    const double cells = beyond(contact.material_a) + beyond(contact.material_b);
    warnings.push_back(fmt::format(
        "/contact/{}/normal: bodies push each other as soon as particles of both reach a node, up to {:.2g} "
        "m before they touch; by \"regression\" only where they touch",
        i, cells * scene.grid.cell_size));
  }
}

/// Whether a body that is away from the wall at an end of an axis comes to it, by its speed or by gravity.
bool comes_to_wall(const tasks::Scene& scene, const tasks::SceneBody& body, int axis, std::size_t side)
{
  const double end = scene.time.end, spacing = scene.grid.cell_size / scene.particles_per_axis_of(body.material);
  const Eigen::Vector3d gravity(scene.gravity.data()), outwards = (side == 0 ? -1 : 1) * Eigen::Vector3d::Unit(axis);
  const double wall = scene.grid.coordinate(axis, side == 0 ? 0 : scene.grid.n_cells[static_cast<std::size_t>(axis)]);
  const double gap = outwards[axis] * wall - reach(body, outwards);
  const Eigen::Vector3d way = way_of(scene, body) + 0.5 * end * end * gravity;
  return gap > 0.5 * spacing && way.dot(outwards) > gap && meets_no_other(scene, body, way.dot(outwards) * outwards);
}

void check_walls(const tasks::Scene& scene, const tasks::SceneBody& body, Warnings& warnings)
{
  if (body.rigid) return;
  for (int axis = 0; axis < scene.grid.dimension; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (!components::traits_of(scene.faces[static_cast<std::size_t>(axis)][side]).has_image()) continue;
      if (!comes_to_wall(scene, body, axis, side)) continue;
      warnings.push_back(fmt::format(
          "/boundaries/{}{}: {} comes to this wall, and is stopped as soon as its particles reach the wall's nodes, up "
          "to {:.2g} m before it touches; it touches where it is with {{\"friction\": MU, \"at_edges\": true}}",
          "xyz"[axis], "-+"[side], body.name,
          (scene.reach_of(body.material) - 0.5 / scene.particles_per_axis_of(body.material)) * scene.grid.cell_size));
    }
  }
}

void check_width(const tasks::Scene& scene, const tasks::SceneBody& body, Warnings& warnings)
{
  const auto penetration = penetration_of(scene, body);
  if (!penetration || !penetration->is_coarse()) return;
  warnings.push_back(
      fmt::format("/bodies/{}/geometry: half its width is only {:.3g} cells; with fewer than {} the force on it "
                  "tends to be a tenth or more too large; cells of at most {:.2g} m are fine enough",
                  body.name, penetration->cells(), least_cells_per_half_width, penetration->fine_cell_size()));
}

void check_mass(const CheckedScene& checked, const tasks::SceneBody& body, Warnings& warnings)
{
  const tasks::Scene& scene = checked.scene;
  // The volume of many solids that overlap takes too long to find.
  constexpr std::size_t few = 10;
  if (std::visit([](const auto& s) { return s.n_shapes(); }, body.solid) > few) return;
  const components::Volume solid = tasks::solid_volume(scene, body);
  const double error = tasks::particle_volume(scene, body) / solid.value - 1;
  if (std::abs(error) - solid.error / solid.value <= 0.01) return;
  const bool can_have_rings =
      scene.grid.dimension == 2 && checked.resolved.at("bodies").at(body.name).at("geometry").at("type") == "ball";
  const bool can_be_cut = body.particles == tasks::ParticleLayout::lattice && !body.initial_stress &&
                          checked.resolved.at("bodies").at(body.name).at("problem").is_null();
  warnings.push_back(
      fmt::format("/bodies/{}/geometry: its particles are off by {:+.3g} % of its mass; finer cells, or more "
                  "particles in each, come closer{}",
                  body.name, 100 * error,
                  can_have_rings ? "; with \"particles\": \"rings\" it is exact"
                  : can_be_cut   ? "; with \"particles\": \"cut\" it is right"
                                 : ""));
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

std::vector<std::string> contact_warnings(const CheckedScene& checked)
{
  Warnings warnings;
  check_approach(checked.scene, warnings);
  for (const tasks::SceneBody& body : checked.scene.bodies) {
    check_tip(checked.scene, body, warnings);
    check_walls(checked.scene, body, warnings);
  }
  return warnings;
}

std::vector<std::string> plausibility_warnings(const CheckedScene& checked)
{
  const tasks::Scene& scene = checked.scene;
  Warnings warnings = checked.warnings;
  for (const InputFile& input : checked.inputs) check_table(input, warnings);
  double fastest_wave = 0;
  for (std::size_t m = 0; m < scene.materials.size(); ++m) {
    check_material(checked, m, warnings);
    fastest_wave = std::max(fastest_wave, tasks::initial_wave_speed(scene.materials[m]));
  }
  check_gravity(scene, warnings);
  check_multiplier(scene, warnings);
  check_contact(scene, warnings);
  for (const tasks::SceneBody& body : scene.bodies) {
    check_speed(body, fastest_wave, warnings);
    check_pressure(scene, body, warnings);
    check_mass(checked, body, warnings);
    check_width(scene, body, warnings);
  }
  return warnings;
}

}  // namespace tamp::tools
