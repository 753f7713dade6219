#include <fmt/format.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "runtime/storage/whole_file.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tools/advice/advice.hpp"
#include "tools/advice/penetration.hpp"
#include "tools/advice/plausibility.hpp"
#include "tools/advice/round_scene.hpp"
#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/forecast.hpp"
#include "tools/scene/bodies/symmetry.hpp"
#include "tools/scene/compiled_moduli.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/study/telling_study.hpp"
#include "tools/system/console.hpp"

namespace tamp::tools
{

namespace
{

struct CheckArguments {
  std::string scene;
  std::vector<std::string> assignments;
  std::string study;
  bool json = false;
  bool no_trial = false;
};

/// The report for people: on stdout, or on stderr where the scene's JSON has stdout to itself.
struct CheckReport {
  bool is_on_stderr;

  template <class... Args>
  void line(fmt::format_string<Args...> format, Args&&... args) const
  {
    const std::string text = without_controls(fmt::format(format, std::forward<Args>(args)...)) + "\n";
    if (is_on_stderr) {
      write_err(text);
    } else {
      write_out(text);
    }
  }
  /// Prints the warnings, a line each.
  void warn(const std::vector<std::string>& warnings) const
  {
    for (const std::string& warning : warnings) line("tamp: warning: {}", warning);
  }
};

/// Counts along the axes that the scene has, such as "48 x 96".
std::string along_axes(const tasks::Scene& scene, const runtime::Index& counts)
{
  return fmt::format("{}", fmt::join(counts.begin(), counts.begin() + scene.grid.dimension, " x "));
}

/// Size of a grid in words, such as "0.12 x 0.24 m".
std::string size_of(const runtime::Grid& grid)
{
  std::vector<double> lengths;
  lengths.reserve(3);
  for (int axis = 0; axis < grid.dimension; ++axis) lengths.push_back(grid.length(static_cast<std::size_t>(axis)));
  return fmt::format("{:.6g} m", fmt::join(lengths, " x "));
}

/// Particles by material in words, such as "100 of steel (hypoelastic), 11520 of sand (tabular_cap)".
std::string particles_by_material(const CheckedScene& checked)
{
  std::vector<std::size_t> counts(checked.scene.materials.size());
  for (const tasks::SceneBody& body : checked.scene.bodies) {
    counts[static_cast<std::size_t>(body.material)] += body.n_particles;
  }
  std::vector<std::string> parts;
  parts.reserve(counts.size());
  for (std::size_t m = 0; m < counts.size(); ++m) {
    const std::string& name = checked.scene.materials[m].name;
    const Json& type = checked.resolved.at("materials").at(name).at("type");
    parts.push_back(fmt::format("{} of {} ({})", counts[m], name, type.get<std::string>()));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

/// Prints the scene's title, kind, grid and particles.
void report_scene(const CheckedScene& checked, const CheckArguments& options, const CheckReport& report)
{
  const tasks::Scene& scene = checked.scene;
  const runtime::Grid& grid = scene.grid;
  const char* const plane = grid.dimension == 3 ? "" : scene.axisymmetric ? ", axisymmetric" : ", plane strain";
  report.line("{}: {}", options.scene, scene.title);
  report.line("  kind  {} dimensions{}, until {} s", grid.dimension, plane, scene.time.end);
  report.line("  grid  {} cells of {} m, {} in all; {}; {} patches", along_axes(scene, grid.n_cells), grid.cell_size,
              grid.cells().size(), size_of(grid), along_axes(scene, scene.n_patches));
  report.line("  particles  {}: {}", scene.n_particles(), particles_by_material(checked));
}

/// Prints the volumes of the solid and of its particles, a line each.
void report_volumes(const tasks::Scene& scene, const tasks::SceneBody& body, const CheckReport& report)
{
  const double density = scene.materials[static_cast<std::size_t>(body.material)].density;
  const components::Volume solid = tasks::solid_volume(scene, body);
  const double filled = tasks::particle_volume(scene, body);
  const std::string known =
      solid.is_exact() ? "exact" : fmt::format("within {:.2g} %", 100 * solid.error / solid.value);
  report.line("        solid      {:.6g} m3, {:.6g} kg ({})", solid.value, density * solid.value, known);
  report.line("        particles  {:.6g} m3, {:.6g} kg ({:+.3g} %)", filled, density * filled,
              100 * (filled / solid.value - 1));
}

/// Prints the number of cells across a body that goes into another one.
void report_cells(const tasks::Scene& scene, const tasks::SceneBody& body, const CheckReport& report)
{
  const auto penetration = penetration_of(scene, body);
  if (!penetration) return;
  report.line("        {:.1f} cells across its half width, going into {}", penetration->cells(),
              penetration->into->name);
}

void report_bodies(const tasks::Scene& scene, const CheckReport& report)
{
  for (const tasks::SceneBody& body : scene.bodies) {
    const std::string& material = scene.materials[static_cast<std::size_t>(body.material)].name;
    report.line("  body  {}: {} particles of {}{}", body.name, body.n_particles, material, body.rigid ? ", rigid" : "");
    report_volumes(scene, body, report);
    report_cells(scene, body, report);
  }
}

/// Throws InputError where the machine has no room for the run.
Forecast expected_forecast(const CheckedScene& checked, bool with_trial)
{
  Forecast forecast = tools::forecast(checked.scene);
  expect_room(checked, forecast);
  add_copies(forecast);
  if (with_trial) add_pace(checked.scene, {}, forecast);
  return forecast;
}

void report_advice(const CheckedScene& checked, const Forecast& forecast, const CheckReport& report)
{
  for (const std::string& line : advice(checked, forecast.pace)) report.line("  advice  {}", line);
  if (const auto to_turn = advice_to_turn(checked.scene)) report.line("  advice  {}", *to_turn);
  if (const auto to_halve = advice_to_halve(checked.scene)) report.line("  advice  {}", *to_halve);
}

void write_study(const CheckedScene& checked, const CheckArguments& options, const CheckReport& report)
{
  const std::filesystem::path file = options.study;
  const Json study =
      study::telling_study(checked, options.scene, options.assignments, std::filesystem::absolute(file).parent_path());
  runtime::write_whole_file(file, json_text(study, 2) + "\n");
  report.line("  study  written to {}; tamp study {} runs it", file.string(), file.string());
}

void check(const CheckArguments& options)
{
  const CheckedScene checked = read_scene(options.scene, options.assignments);
  expect_outputs({{"--study", options.study}});
  const CheckReport report{options.json};
  if (options.json) print_out("{}\n", printed(checked.resolved));
  print_notes(checked.notes);

  report_scene(checked, options, report);
  report_bodies(checked.scene, report);
  for (const std::string& line : compiled_moduli(checked)) report.line("  {}", line);
  for (const std::string& line : checked.remarks) report.line("  {}", line);
  report.warn(plausibility_warnings(checked));
  report.warn(material_warnings(checked));
  report.warn(contact_warnings(checked));
  const Forecast forecast = expected_forecast(checked, !options.no_trial);
  report.line("  {}", description(forecast));
  report_advice(checked, forecast, report);
  if (!options.study.empty()) write_study(checked, options, report);
}

}  // namespace

CLI::App* add_check_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("check", "Check and summarise a scene, estimate its cost, and give advice");
  const auto options = std::make_shared<CheckArguments>();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  add_assignments(*command, options->assignments, "scene");
  command->add_flag("--json", options->json,
                    "print the scene as JSON with every default filled in; all other output goes to stderr");
  command->add_flag("--no-trial", options->no_trial,
                    "try no steps on coarser cells: no forecast of steps and time, no advice that needs it");
  command
      ->add_option(
          "--study", options->study,
          "write a study that tells how far the scene is off, for `tamp study`: on three grids, compared with a "
          "method on the front of cost and error")
      ->type_name("OUT.json");
  command->footer(examples(
      {{"tamp check inputs/punch/quick.json",
        "its particles, masses, memory and time; in lines of advice what bounds the step and what a "
        "rigid body would save, cells, the box that waves see, methods off the front (docs/reference/advice.md)"},
       {"tamp check inputs/punch/quick.json --set /grid/cell_size=0.0125", "the same on finer cells"},
       {"tamp check inputs/punch/quick.json --json > plain.json",
        "the scene with its materials in it and no key left out"}}));
  command->callback([options] { check(*options); });
  return command;
}

}  // namespace tamp::tools
