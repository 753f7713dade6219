#include <fmt/core.h>

#include <cmath>
#include <memory>
#include <variant>

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
};

/// How much the solid and its particles hold, a line each.
void print_volumes(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  const double density = scene.materials[static_cast<std::size_t>(body.material)].density;
  const components::Volume solid = tasks::solid_volume(scene, body);
  const double filled = tasks::particle_volume(scene, body);
  const std::string known =
      solid.is_exact() ? "exact" : fmt::format("within {:.2g} %", 100 * solid.error / solid.value);
  print_err("        solid      {:.6g} m3, {:.6g} kg ({})\n", solid.value, density * solid.value, known);
  print_err("        particles  {:.6g} m3, {:.6g} kg ({:+.3g} %)\n", filled, density * filled,
            100 * (filled / solid.value - 1));
}

/// On how many cells a body goes into another one, if it does.
void print_cells(const tasks::Scene& scene, const tasks::SceneBody& body)
{
  const auto penetration = penetration_of(scene, body);
  if (!penetration) return;
  print_err("        {:.1f} cells to its half width, on its way into {}\n", penetration->cells(),
            penetration->into->name);
}

void write_study(const CheckedScene& checked, const CheckArguments& options)
{
  const std::filesystem::path file = options.study;
  const Json study =
      study::telling_study(checked, options.scene, options.assignments, std::filesystem::absolute(file).parent_path());
  runtime::write_whole_file(file, json_text(study, 2) + "\n");
  print_err("  study  written to {}; tamp study {} runs it\n", file.string(), file.string());
}

void check(const CheckArguments& options)
{
  const CheckedScene checked = read_scene(options.scene, options.assignments);
  const tasks::Scene& scene = checked.scene;
  expect_outputs({{"--study", options.study}});
  print_out("{}\n", printed(checked.resolved));

  const runtime::Index& n = scene.grid.n_cells;
  const runtime::Index& patches = scene.n_patches;
  print_err("{}: {} cells, {} patches\n", options.scene, scene.grid.cells().size(),
            patches[0] * patches[1] * patches[2]);
  print_err("  grid  {} x {} x {} cells of {} m\n", n[0], n[1], n[2], scene.grid.cell_size);
  for (const tasks::SceneBody& body : scene.bodies) {
    const std::string& material = scene.materials[static_cast<std::size_t>(body.material)].name;
    print_err("  body  {}: {} particles of {}\n", body.name, body.n_particles, material);
    print_volumes(scene, body);
    print_cells(scene, body);
  }
  for (const std::string& line : compiled_moduli(checked)) print_err("  {}\n", line);
  for (const std::string& line : checked.remarks) print_err("  {}\n", line);
  print_notes(checked.notes);
  print_warnings(plausibility_warnings(checked));
  print_warnings(material_warnings(checked));
  print_warnings(contact_warnings(checked));
  Forecast forecast = tools::forecast(scene);
  expect_room(checked, forecast);
  add_copies(forecast);
  add_pace(scene, {}, forecast);
  print_err("  {}\n", description(forecast));
  for (const std::string& line : advice(checked, forecast.pace)) print_err("  advice  {}\n", line);
  if (!options.study.empty()) write_study(checked, options);
  if (const auto to_turn = advice_to_turn(scene)) print_err("  advice  {}\n", *to_turn);
  if (const auto to_halve = advice_to_halve(scene)) print_err("  advice  {}\n", *to_halve);
}

}  // namespace

CLI::App* add_check_command(CLI::App& app)
{
  CLI::App* command =
      app.add_subcommand("check", "Check a scene, print it with every default filled in, forecast and advise");
  const auto options = std::make_shared<CheckArguments>();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  add_assignments(*command, options->assignments, "scene");
  command
      ->add_option(
          "--study", options->study,
          "write a study that tells how far the scene is off, for `tamp study`: on three grids, beside a method "
          "that is on the front")
      ->type_name("OUT.json");
  command->footer(examples(
      {{"tamp check inputs/punch/quick.json",
        "the scene resolved, its particles, memory and time; in lines of advice what bounds the step and what a "
        "rigid body would save, cells, the box that waves see, methods off the front (docs/findings/savings.md)"},
       {"tamp check inputs/punch/quick.json --set /grid/cell_size=0.0125", "the same on finer cells"}}));
  command->callback([options] { check(*options); });
  return command;
}

}  // namespace tamp::tools
