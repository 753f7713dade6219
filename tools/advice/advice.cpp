#include "tools/advice/advice.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "tools/advice/measured_errors.hpp"
#include "tools/advice/penetration.hpp"
#include "tools/advice/rigidity.hpp"
#include "tools/advice/wave_box.hpp"
#include "tools/scene/bodies/symmetry.hpp"
#include "tools/scene/files/digits.hpp"

namespace tamp::tools
{

namespace
{

using Lines = std::vector<std::string>;

const tasks::SceneMaterial& material_of(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  return scene.materials[static_cast<std::size_t>(body.material)];
}

/// A comparison in words, such as "about 1100 steps for 3200, 0.4 of the time".
std::string compared(const tasks::Pace& other, const tasks::Pace& own)
{
  constexpr double noise = 0.9;
  const double part = other.core_seconds / own.core_seconds;
  return fmt::format("about {} steps for {}, {}", two_digits(other.n_steps), two_digits(own.n_steps),
                     part < noise ? fmt::format("{:.2g} of the time", part) : "in no less time");
}

/// A rigid body has a material to itself, and nothing that needs its stress.
bool can_be_rigid(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  const auto& periodic = scene.grid.periodic;
  const auto shares = [&](const tasks::SceneBody& other) { return &other != &body && other.material == body.material; };
  return !body.initial_stress && !body.is_pressed() && std::none_of(scene.bodies.begin(), scene.bodies.end(), shares) &&
         std::none_of(periodic.begin(), periodic.end(), [](bool is) { return is; });
}

tasks::Scene with_rigid(tasks::Scene scene, const tasks::SceneBody& body)
{
  const auto is_it = [&](const tasks::SceneBody& other) { return other.name == body.name; };
  std::find_if(scene.bodies.begin(), scene.bodies.end(), is_it)->rigid = true;
  return scene;
}

/// The error of a rigid body's depth, in words.
std::string depth_if_rigid(const Rigidity& rigidity)
{
  if (rigidity.is_soft()) {
    return fmt::format("its depth is more than 1 % off a deformable one's, as it is strained by {:.0f} %",
                       100 * rigidity.strain);
  }
  return fmt::format("its depth is {} {:.2g} % off a deformable one's", rigidity.is_safe() ? "only some" : "some",
                     100 * rigidity.depth_error());
}

/// Advises on a body that bounds the step, where a body that goes into another is rigid or could be.
void advise_on_step(const tasks::Scene& scene, const tasks::SceneBody& body, const Penetration& penetration,
                    const std::optional<tasks::Pace>& pace, Lines& lines)
{
  if (body.drive || !pace) return;
  const std::string ground = penetration.into->name;
  const std::string waves = fmt::format("waves of {:.0f} m/s in {}, {:.0f} in {}", waves_in(scene, body), body.name,
                                        waves_in(scene, *penetration.into), ground);
  const std::string depth = depth_if_rigid(rigidity_of(scene, body, penetration));
  if (body.rigid) {
    lines.push_back(fmt::format("step: {} sets it, {} is rigid ({}); {}", ground, body.name, waves, depth));
    return;
  }
  if (!can_be_rigid(scene, body)) return;
  const auto rigid = tasks::pace_of(with_rigid(scene, body), {});
  if (!rigid || !(rigid->n_steps > 0)) return;
  constexpr double worth_it = 1.2;
  const bool sets_it = pace->n_steps > worth_it * rigid->n_steps;
  lines.push_back(fmt::format("step: {} sets it ({}); rigid, {} would take {}; {}", sets_it ? body.name : ground, waves,
                              body.name, compared(*rigid, *pace), depth));
}

/// Advises on a time step rule whose steps are shorter than those known to be stable, which costs as much more.
void advise_on_rule(const tasks::Scene& scene, const std::optional<tasks::Pace>& pace, Lines& lines)
{
  if (scene.time.rule != components::StepRule::published || scene.time.multiplier >= 0.5 || !pace) return;
  tasks::Scene other = scene;
  other.time.rule = components::StepRule::viscous;
  other.time.multiplier = 1;
  const auto viscous = tasks::pace_of(other, {});
  if (!viscous || !(viscous->n_steps < pace->n_steps)) return;
  lines.push_back(fmt::format("rule: \"published\" times {:.3g} takes short steps; \"viscous\" times 1 would take {}",
                              scene.time.multiplier, compared(*viscous, *pace)));
}

bool is_compacted_sand(const tasks::Scene& scene, const tasks::SceneBody& ground)
{
  return std::holds_alternative<components::TabularCap>(material_of(scene, ground).model);
}

constexpr const char* not_known =
    "not known for this scene (`tamp check SCENE --study OUT.json` writes the study that tells)";

/// Relative excess of the force on a body that goes into sand like the punch that was measured: with a flat end, in the
/// plane, at 200 m/s.
std::optional<MeasuredError> force_error(const CheckedScene& checked, const tasks::SceneBody& body,
                                         const Penetration& penetration)
{
  const tasks::Scene& scene = checked.scene;
  const Json& geometry = checked.resolved.at("bodies").at(body.name).at("geometry");
  constexpr double measured_speed = 200, alike = 0.01;
  const double speed =
      body.drive ? way_of(scene, body).norm() / scene.time.end : Eigen::Vector3d(body.velocity.data()).norm();
  const bool is_like_it = scene.grid.dimension == 2 && !scene.axisymmetric && geometry.at("type") == "box" &&
                          std::abs(speed / measured_speed - 1) < alike && is_compacted_sand(scene, *penetration.into);
  if (!is_like_it) return std::nullopt;
  return measured_error(scene, "flat punch", penetration.cells());
}

void advise_on_cells(const CheckedScene& checked, const tasks::SceneBody& body, const Penetration& penetration,
                     Lines& lines)
{
  const auto error = force_error(checked, body, penetration);
  std::string line =
      fmt::format("cells: {} has {:.1f} to its half width, and {} {:.0f}; ", body.name, penetration.cells(),
                  penetration.is_coarse() ? "needs" : "needs no more than", least_cells_per_half_width);
  line += error ? fmt::format("the force on it is {} too large ({})", error->text(), error->command)
                : fmt::format("by how much the force on it is too large is {}", not_known);
  if (penetration.is_coarse()) {
    const tasks::Scene& scene = checked.scene;
    const double finer = scene.grid.cell_size / penetration.fine_cell_size();
    line += fmt::format("; cells of {:.2g} m cost {} times as much", penetration.fine_cell_size(),
                        two_digits(std::pow(finer, scene.grid.dimension + 1)));
  }
  lines.push_back(line);
}

/// The parts of a scene's method that the front of cost and error compares, in words.
std::string method_of(const tasks::Scene& scene)
{
  const auto& viscosity = scene.artificial_viscosity;
  const std::string coefficients =
      viscosity ? fmt::format("viscosity {:.3g} / {:.3g}", viscosity->linear, viscosity->quadratic) : "no viscosity";
  return fmt::format("\"{}\", \"{}\", {}", scene.interpolator.word(), scene.transfer.word(), coefficients);
}

/// Advice on a method that is not on the front of cost and error: its error, as far as that was measured, and the
/// methods of the front.
std::string off_the_front(const tasks::Scene& scene, const std::string& what, const std::optional<MeasuredError>& error,
                          const std::string& front)
{
  if (!error) {
    return fmt::format("method: the error of {} in {} is {}; {}", method_of(scene), what, not_known, front);
  }
  return fmt::format("method: {} is off the front of cost and error: {} is {} off ({}); {}", method_of(scene), what,
                     error->text(), error->command, front);
}

/// Advises on the method for sand that is compacted fast, in the plane, by a body that is many cells thick.
void advise_on_plane_method(const tasks::Scene& scene, Lines& lines)
{
  constexpr double cells_a_metre = 100, on_front_within = 0.01;
  const auto error = measured_error(scene, "piston", cells_a_metre);
  const bool is_cheap = scene.interpolator == tasks::Interpolator("cubic_spline");
  if (is_cheap && error && error->greatest < on_front_within) return;
  lines.push_back(off_the_front(scene, "the force on a piston at 200 m/s", error,
                                "with \"cubic_spline\", \"flip\", viscosity 1 / 4 it is 0.5 %"));
}

/// The same for a body that is a few cells thick, or in space.
void advise_on_thin_method(const tasks::Scene& scene, Lines& lines)
{
  if (scene.interpolator == tasks::Interpolator("gimp") && scene.transfer == tasks::Transfer("tflip")) return;
  constexpr double cells_to_half_width = 0.5;
  lines.push_back(off_the_front(scene, "the turn of a thin body",
                                measured_error(scene, "turn of a thin rod", cells_to_half_width),
                                "with \"gimp\", \"tflip\" it is 0.1 %, for 1.27 times a step"));
}

/// Advises on the method for soil that is pressed, and hardly changes its volume.
void advise_on_pressed_method(const tasks::Scene& scene, Lines& lines)
{
  const bool on_front = scene.interpolator == tasks::Interpolator("quadratic_spline") &&
                        scene.anti_locking == tasks::AntiLocking::cell_average;
  if (on_front) return;
  constexpr double cells_a_width = 20;
  lines.push_back(off_the_front(scene, "the load of a strip footing 20 cells wide",
                                measured_error(scene, "strip footing", cells_a_width),
                                "with \"quadratic_spline\" and anti_locking \"cell_average\" it is 3.6 %"));
}

/// Whether it is one cell thick between smooth walls, and so in plane strain.
bool is_slab(const tasks::Scene& scene)
{
  return scene.grid.dimension == 3 &&
         (is_one_cell_thick(scene, 0) || is_one_cell_thick(scene, 1) || is_one_cell_thick(scene, 2));
}

/// Advises on the method by the front of cost against error in cells_and_method.md and which_method_for_least_cost.md.
void advise_on_method(const tasks::Scene& scene, const tasks::SceneBody& body, Lines& lines)
{
  const auto& model = material_of(scene, body).model;
  if (body.pressure && scene.grid.dimension == 2 && std::holds_alternative<components::DruckerPrager>(model)) {
    advise_on_pressed_method(scene, lines);
  }
  const auto penetration = penetration_of(scene, body);
  constexpr double fast = 20, thick = 4;
  if (!penetration || way_of(scene, body).norm() < fast * scene.time.end) return;
  if (!is_compacted_sand(scene, *penetration->into)) return;
  const bool is_thick = (scene.grid.dimension == 2 || is_slab(scene)) && penetration->cells() >= thick;
  const bool may_turn = !scene.axisymmetric && !(body.drive && !body.drive->turns);
  if (is_thick && !scene.axisymmetric) {
    advise_on_plane_method(scene, lines);
  } else if (may_turn) {
    advise_on_thin_method(scene, lines);
  }
}

/// How coarse the lattice of a rigid body is, beside its width where it goes into another.
std::string spacing_in_words(const tasks::Scene& scene, int material)
{
  const double spacing = scene.grid.cell_size / scene.particles_per_axis_of(material);
  const auto is_it = [&](const tasks::SceneBody& body) { return body.material == material; };
  const auto penetration = penetration_of(scene, *std::ranges::find_if(scene.bodies, is_it));
  if (!penetration || !std::isfinite(penetration->half_width)) return fmt::format("{:.2g} m apart", spacing);
  return fmt::format("{:.2g} m apart, {:.2g} to its half width", spacing, penetration->half_width / spacing);
}

/// Advises on contact with a rigid body by other normals than those of its solid: it is then with the body's particles,
/// whose lattice is blunter than the body.
void advise_on_contact(const tasks::Scene& scene, Lines& lines)
{
  if (scene.is_periodic()) return;
  for (const tasks::SceneContact& contact : scene.contacts) {
    const bool first_is_rigid = scene.is_rigid(contact.material_a);
    if (first_is_rigid == scene.is_rigid(contact.material_b)) continue;
    if (std::holds_alternative<components::SolidNormal>(contact.normal)) continue;
    const auto name = [&](int material) { return scene.materials[static_cast<std::size_t>(material)].name; };
    const int rigid = first_is_rigid ? contact.material_a : contact.material_b;
    const int other = first_is_rigid ? contact.material_b : contact.material_a;
    lines.push_back(
        fmt::format("contact: with \"normal\": \"solid\" {} would touch the solid of {} instead of its particles, {}, "
                    "whose outline is blunter",
                    name(other), name(rigid), spacing_in_words(scene, rigid)));
  }
}

}  // namespace

std::vector<std::string> advice(const CheckedScene& checked, const std::optional<tasks::Pace>& pace)
{
  const tasks::Scene& scene = checked.scene;
  Lines lines;
  bool is_first = true;
  for (const tasks::SceneBody& body : scene.bodies) {
    if (const auto penetration = penetration_of(scene, body)) {
      // Each body would take trial runs of its own.
      if (std::exchange(is_first, false)) advise_on_step(scene, body, *penetration, pace, lines);
      advise_on_cells(checked, body, *penetration, lines);
      const std::string on_box = advice_on_box(scene, body, *penetration->into);
      if (!on_box.empty()) lines.push_back(on_box);
    }
    advise_on_method(scene, body, lines);
  }
  advise_on_contact(scene, lines);
  advise_on_rule(scene, pace, lines);
  if (is_slab(scene)) {
    lines.push_back(
        "slab: one cell between smooth walls is plane strain; in 2 dimensions the quick punch is as deep to 0.01 %, "
        "for "
        "a fifth of the time");
  }
  return lines;
}

}  // namespace tamp::tools
