#include "tools/study/compare/compare.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <memory>

#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/forecast.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/study/compare/comparison_report.hpp"
#include "tools/study/compare/grid_error.hpp"
#include "tools/study/compare/peak_memory.hpp"
#include "tools/system/charts.hpp"
#include "tools/system/console.hpp"
#include "tools/system/usable_cores.hpp"

namespace tamp::tools
{

namespace
{

struct CompareArguments {
  std::string scene;
  std::vector<std::string> models{"table", "svr", "mlp"};
  std::vector<std::string> assignments;
  std::string out;
  bool with_grid_error = true;
  compare::Options comparison;
};

std::vector<std::optional<std::size_t>> measure_memory(const CompareArguments& options,
                                                       const std::vector<compare::ModelScene>& scenes)
{
  // Memory is allocated in the first step; a few more let the sand begin to move.
  const long n_steps = std::min(options.comparison.max_steps, 20L);
  std::vector<std::optional<std::size_t>> bytes;
  bytes.reserve(scenes.size());
  for (const compare::ModelScene& scene : scenes) {
    bytes.push_back(compare::peak_rss_alone(options.scene, scene.assignments, options.comparison.n_threads, n_steps,
                                            options.comparison.folder / scene.name / "alone"));
  }
  return bytes;
}

void write(const compare::Comparison& comparison, const std::filesystem::path& folder)
{
  runtime::write_whole_file(folder / "compare.csv", to_csv(comparison));
  runtime::write_whole_file(folder / "compare.json", json_text(to_json(comparison), 1) + "\n");
}

/// The models that went wrong, in the way of a single run.
void throw_if_unstable(const compare::Comparison& comparison)
{
  std::vector<std::string> lines;
  for (const compare::ModelResult& model : comparison.models) {
    if (model.unstable()) lines.push_back(fmt::format("{}: {}", model.name, model.instability));
  }
  if (!lines.empty()) throw tasks::SimulationError(fmt::format("{}", fmt::join(lines, "\n")), "", -1, {});
}

void compare_models(CompareArguments& options)
{
  const auto scenes = compare::read_model_scenes(options.scene, options.assignments, options.models);
  print_notes(scenes.front().scene.notes);
  options.comparison.folder = options.out.empty() ? "compare/" + scenes.front().scene.scene.name : options.out;
  for (const compare::ModelScene& scene : scenes) expect_room(scene.scene, forecast(scene.scene.scene));
  const bool has_differences = options.with_grid_error && scenes.size() > 1;
  const auto coarser = has_differences ? compare::coarser_scene(options.scene, scenes.front()) : std::nullopt;
  auto all_scenes = scenes;
  if (coarser) all_scenes.push_back(*coarser);
  const auto folders = prepare_folders(options.comparison, all_scenes);
  const auto memory = measure_memory(options, scenes);

  compare::Comparison comparison = compare::compare(scenes, options.comparison);
  if (coarser) {
    comparison.coarser = compare::run_coarser(*coarser, common_time(comparison), options.comparison.n_threads,
                                              options.comparison.folder / coarser->name);
  }
  for (std::size_t m = 0; m < memory.size(); ++m) comparison.models[m].peak_rss_bytes = memory[m];

  write(comparison, options.comparison.folder);
  if (!options.comparison.quiet) {
    print_out("{}  written to {}\n", to_text(comparison), options.comparison.folder.string());
  }
  draw_page(options.comparison.folder);
  throw_if_unstable(comparison);
}

}  // namespace

CLI::App* add_compare_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("compare", "Run a scene with several models of the sand, and compare them");
  const auto options = std::make_shared<CompareArguments>();
  options->comparison.n_threads = usable_cores().of_machine;
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  command
      ->add_option("--models", options->models,
                   fmt::format("models, with commas between: {}", fmt::join(compare::model_names(), ", ")))
      ->delimiter(',')
      ->allow_extra_args(false);
  command->add_option("--out", options->out, "the comparison's folder; by default compare/ and the scene's name")
      ->type_name("DIR");
  add_assignments(*command, options->assignments, "scene");
  command->add_option("--threads", options->comparison.n_threads, "threads; by default the cores that may be used")
      ->check(is_whole_from_to(1, 1024));
  command->add_option("--until", options->comparison.until, "stop at this simulated time, in seconds")
      ->check(is_above_zero())
      ->default_str("the scene's end");
  command->add_option("--steps", options->comparison.max_steps, "stop each model after so many steps")
      ->check(is_whole_from(1))
      ->default_str("no limit");
  command->add_flag("!--no-grid-error", options->with_grid_error,
                    "do not run the first model on cells twice as large, which shows what the grid changes");
  command->add_flag("--force", options->comparison.force, "replace what an earlier comparison left in the folder");
  command->add_flag("--quiet", options->comparison.quiet, "print no progress and no table");
  command->footer(
      examples({{"tamp compare inputs/punch/quick.json --models table,svr,mlp", "cost and results of all three"},
                {"tamp compare inputs/punch/quick.json --steps 500 --out compare/short", "the first steps only"}}));
  command->callback([options] { compare_models(*options); });
  return command;
}

}  // namespace tamp::tools
