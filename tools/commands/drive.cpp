#include <fmt/core.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>
#include <optional>
#include <variant>

#include "runtime/storage/whole_file.hpp"
#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/drive/columns.hpp"
#include "tools/run/drive/drive.hpp"
#include "tools/run/drive/drive_costs.hpp"
#include "tools/run/drive/read_path.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/materials/read_material.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

struct DriveArguments {
  std::string material;
  std::string path;
  std::vector<std::string> assignments;
  std::string out;
  double increment = 1e-3;
  std::string summary;
  int repeat = 5;
};

void write_summary(const DriveCosts& costs, const std::filesystem::path& file)
{
  const auto per_update = [&](std::size_t n) { return static_cast<double>(n) / static_cast<double>(costs.n_updates); };
  const nlohmann::ordered_json summary{{"updates", costs.n_updates},
                                       {"substeps", costs.counts.substeps},
                                       {"limited_substeps", costs.counts.limited_substeps},
                                       {"modulus_evaluations", costs.counts.modulus_evaluations},
                                       {"evaluations_per_update", per_update(costs.counts.modulus_evaluations)},
                                       {"ns_per_update", costs.ns_per_update}};
  write_output({"--summary", file}, json_text(summary, 2) + "\n");
}

void check_finite(const DriveArguments& options, const tasks::MaterialModel& model, const std::vector<double>& values)
{
  const auto wrong = std::find_if(values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
  if (wrong == values.end()) return;
  const std::string column = drive_columns(model)[static_cast<std::size_t>(wrong - values.begin())];
  throw InputError({options.material, fmt::format("{} is {} at time {}", column, *wrong, values.front()),
                    "expected constants and a path that give numbers"});
}

void drive_point(const DriveArguments& options)
{
  const CheckedMaterial checked = read_checked_material(options.material, options.assignments);
  print_notes(checked.notes);
  print_warnings(checked.warnings);
  const tasks::SceneMaterial& material = checked.material;
  const LoadPath path = read_path(options.path);
  expect_outputs({{"--out", options.out}, {"--summary", options.summary}});
  std::optional<runtime::WholeFile> file;
  if (!options.out.empty()) file.emplace(options.out);
  const auto write_line = [&](const auto& values) {
    const std::string line = fmt::format("{}\n", fmt::join(values, ","));
    file ? file->write(line) : print_out("{}", line);
  };
  write_line(drive_columns(material.model));
  std::vector<MaterialPoint> points;
  const ShowPoint show = [&](double time, const MaterialPoint& point) {
    if (!options.summary.empty()) points.push_back(point);
    const std::vector<double> values = drive_values(material.model, time, point);
    check_finite(options, material.model, values);
    write_line(values);
  };
  std::visit([&](const auto& any_path) { drive(material, any_path, options.increment, show); }, path);
  if (file) file->publish();
  if (points.empty()) return;
  write_summary(drive_costs(material.model, points, options.repeat), options.summary);
}

}  // namespace

CLI::App* add_drive_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("drive", "Take one material point along a path, as CSV");
  const auto options = std::make_shared<DriveArguments>();
  command->add_option("MATERIAL", options->material, "the material's JSON file")->required();
  command
      ->add_option(
          "PATH", options->path,
          "CSV (time,F11,F12,...,F33, or S11 and so on, stress in Pa, tension positive, in place of F11; shear "
          "may be left out), or prescribed-deformation text")
      ->required();
  add_assignments(*command, options->assignments, "material");
  command->add_option("--increment", options->increment, "largest strain of an increment")
      ->check(is_from_to(1e-9, 0.1));
  command->add_option("--out", options->out, "write to this file")->type_name("FILE");
  CLI::Option* summary =
      command->add_option("--summary", options->summary, "write what the updates cost to this file, as JSON")
          ->type_name("FILE");
  command->add_option("--repeat", options->repeat, "rounds that the updates are timed in for --summary, by default 5")
      ->check(is_whole_from_to(1, 1000))
      ->needs(summary);
  command->footer(examples(
      {{"tamp drive inputs/materials/concrete-sand/table.json path.csv --out answer.csv", "stresses along the path"},
       {"tamp drive inputs/materials/concrete-sand/mlp.json path.csv --summary cost.json",
        "and what an update costs"}}));
  command->callback([options] { drive_point(*options); });
  return command;
}

}  // namespace tamp::tools
