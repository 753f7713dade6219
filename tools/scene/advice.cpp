#include "tools/scene/advice.hpp"

#include <fmt/format.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <utility>
#include <variant>

#include "tools/scene/digits.hpp"
#include "tools/scene/penetration.hpp"
#include "tools/scene/rigidity.hpp"
#include "tools/scene/symmetry.hpp"
#include "tools/scene/wave_box.hpp"

namespace tamp::tools
{

namespace
{

using Lines = std::vector<std::string>;

const tasks::SceneMaterial& material_of(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  return scene.materials[static_cast<std::size_t>(body.material)];
}

/// Such as "about 1100 steps for 3200, 0.4 of the time".
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

/// How sure the depth of a rigid body is.
std::string depth_if_rigid(const Rigidity& rigidity)
{
  if (rigidity.is_soft()) {
    return fmt::format("its depth is more than 1 % off a deformable one's, as it is strained by {:.0f} %",
                       100 * rigidity.strain);
  }
  return fmt::format("its depth is {} of a deformable one's, some {:.2g} % off",
                     rigidity.is_safe() ? "within 1 %" : "not within 1 %", 100 * rigidity.depth_error());
}

/// Which body bounds the step, as far as one that goes into another is rigid or could be.
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

/// Shorter steps than are known to be stable cost as much more.
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

/// The force on coarse cells is too large by about 420 % over the square of their number in sand that is compacted (the
/// table in choosing.md).
void advise_on_cells(const tasks::Scene& scene, const tasks::SceneBody& body, const Penetration& penetration,
                     Lines& lines)
{
  const double cells = penetration.cells();
  std::string line = fmt::format("cells: {} has {:.1f} to its half width, and needs {:.0f}", body.name, cells,
                                 least_cells_per_half_width);
  if (is_compacted_sand(scene, *penetration.into)) {
    line += fmt::format("; the force on it is some {} % too large", two_digits(420 / (cells * cells)));
  }
  if (penetration.is_coarse()) {
    const double finer = scene.grid.cell_size / penetration.fine_cell_size();
    line += fmt::format("; cells of {:.2g} m cost {} times as much", penetration.fine_cell_size(),
                        two_digits(std::pow(finer, scene.grid.dimension + 1)));
  }
  lines.push_back(line);
}

/// A linear coefficient from which pressure behind a front does not swing.
bool has_enough_viscosity(const tasks::Scene& scene)
{
  return scene.artificial_viscosity && scene.artificial_viscosity->linear >= 0.75;
}

/// How far off the force on a piston in sand at 200 m/s is, on cells of 1 cm, by the tables in choosing.md and
/// viscosity.md.
std::string piston_error(const tasks::Scene& scene)
{
  if (!has_enough_viscosity(scene)) return "3 to 8 %";
  if (scene.interpolator == tasks::Interpolator("cubic_spline")) return "0.5 %";
  if (scene.interpolator == tasks::Interpolator("quadratic_spline")) return "0.9 %";
  return scene.interpolator == tasks::Interpolator("cpdi") ? "1.5 %" : "3.5 %";
}

/// What the front is about, of a scene.
std::string method_of(const tasks::Scene& scene)
{
  const auto& viscosity = scene.artificial_viscosity;
  const std::string coefficients =
      viscosity ? fmt::format("viscosity {:.3g} / {:.3g}", viscosity->linear, viscosity->quadratic) : "no viscosity";
  return fmt::format("\"{}\", \"{}\", {}", scene.interpolator.word(), scene.transfer.word(), coefficients);
}

/// Sand that is compacted fast, in the plane, by a body that is many cells thick.
void advise_on_plane_method(const tasks::Scene& scene, Lines& lines)
{
  const bool transfers_well = scene.transfer == tasks::Transfer("flip") || scene.transfer == tasks::Transfer("tflip") ||
                              scene.transfer == tasks::Transfer("apic");
  const bool on_front =
      scene.interpolator == tasks::Interpolator("cubic_spline") && has_enough_viscosity(scene) && transfers_well;
  if (on_front) return;
  lines.push_back(
      fmt::format("method: {} is off the front of cost and error: the force on a piston at 200 m/s is {} "
                  "off; with \"cubic_spline\", \"flip\", viscosity 1 / 4 it is 0.5 %",
                  method_of(scene), piston_error(scene)));
}

/// The same by a body a few cells thick, or in space.
void advise_on_thin_method(const tasks::Scene& scene, Lines& lines)
{
  if (scene.interpolator == tasks::Interpolator("gimp") && scene.transfer == tasks::Transfer("tflip")) return;
  lines.push_back(
      fmt::format("method: {} is off the front of cost and error for bodies a few cells thick: \"flip\" "
                  "turns them 35 % too slowly, splines thicken them; \"gimp\", \"tflip\" turns them 0.1 % "
                  "too slowly, for 1.27 times a step",
                  method_of(scene)));
}

/// Soil that is pressed, and hardly changes its volume.
void advise_on_pressed_method(const tasks::Scene& scene, Lines& lines)
{
  const bool on_front = scene.interpolator == tasks::Interpolator("quadratic_spline") &&
                        scene.anti_locking == tasks::AntiLocking::cell_average;
  if (on_front) return;
  lines.push_back(
      fmt::format("method: {} is off the front of cost and error for soil that keeps its volume: on 20 cells "
                  "a strip footing bears 10 to 19 % too much without anti-locking, 4 to 7 % with "
                  "\"quadratic_spline\" and \"cell_average\"",
                  method_of(scene)));
}

/// Whether it is one cell thick between smooth walls, and so in plane strain.
bool is_slab(const tasks::Scene& scene)
{
  return scene.grid.dimension == 3 &&
         (is_one_cell_thick(scene, 0) || is_one_cell_thick(scene, 1) || is_one_cell_thick(scene, 2));
}

/// The front that is meant is that of cost against error in choosing.md and verification.md.
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

}  // namespace

std::vector<std::string> advice(const tasks::Scene& scene, const std::optional<tasks::Pace>& pace)
{
  Lines lines;
  bool is_first = true;
  for (const tasks::SceneBody& body : scene.bodies) {
    if (const auto penetration = penetration_of(scene, body)) {
      // Each body would take trial runs of its own.
      if (std::exchange(is_first, false)) advise_on_step(scene, body, *penetration, pace, lines);
      advise_on_cells(scene, body, *penetration, lines);
      const std::string on_box = advice_on_box(scene, body, *penetration->into);
      if (!on_box.empty()) lines.push_back(on_box);
    }
    advise_on_method(scene, body, lines);
  }
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
