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
#include "tools/run/drive/drive_page.hpp"
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
  LaboratoryTest test;
  std::vector<std::string> assignments;
  std::string out;
  double increment = 1e-3;
  std::string plot;
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

/// Options that the test has no use for are refused.
void check_test_options(const CLI::App& command, const std::string& test)
{
  const auto refuse = [&](const std::string& option, const std::string& expected) {
    if (command.count(option) > 0) throw InputError({option, "given with --test " + test, expected});
  };
  if (!goes_to_strain(test)) refuse("--strain", "expected --pressure, to which it goes");
  if (!has_lateral_ratio(test)) refuse("--k0", "expected no lateral stress, which it answers");
}

using Load = std::variant<DeformationPath, MixedPath, LaboratoryTest>;

Load asked_load(const DriveArguments& options)
{
  if (!options.test.name.empty()) return options.test;
  return std::visit([](auto path) -> Load { return path; }, read_path(options.path));
}

std::string title_of(const DriveArguments& options)
{
  const bool is_test = !options.test.name.empty();
  return options.material + (is_test ? ", test " + options.test.name : " along " + options.path);
}

void drive_point(const DriveArguments& options)
{
  const CheckedMaterial checked = read_checked_material(options.material, options.assignments);
  print_notes(checked.notes);
  print_warnings(checked.warnings);
  const tasks::SceneMaterial& material = checked.material;
  const Load asked = asked_load(options);
  expect_outputs({{"--out", options.out}, {"--plot", options.plot}, {"--summary", options.summary}});
  std::optional<runtime::WholeFile> file;
  if (!options.out.empty()) file.emplace(options.out);
  std::string rows;  // for the page
  const auto write_line = [&](const auto& values) {
    const std::string line = fmt::format("{}\n", fmt::join(values, ","));
    if (!options.plot.empty()) rows += line;
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
  std::visit([&](const auto& load) { drive(material, load, options.increment, show); }, asked);
  if (file) file->publish();
  if (!points.empty()) write_summary(drive_costs(material.model, points, options.repeat), options.summary);
  if (!options.plot.empty()) write_drive_page(rows, title_of(options), options.plot);
}

/// Options of a laboratory test, which stands in place of a path.
void add_test_options(CLI::App& command, CLI::Option* path, LaboratoryTest& test)
{
  CLI::Option* name =
      command.add_option("--test", test.name, "a test of the soil laboratory; axis 1 is axial, in simple shear axis 2")
          ->type_name("NAME")
          ->check(is_one_of(laboratory_test_names()))
          ->excludes(path);
  const auto add = [&](const std::string& option, auto& value, const std::string& meaning) {
    return command.add_option(option, value, meaning)->needs(name);
  };
  add("--pressure", test.pressure, "axial stress at the start, of isotropic at the end; Pa, compression positive")
      ->check(is_at_least_zero());
  add("--k0", test.lateral_ratio,
      "lateral over axial stress at the start, for triaxial, simple_shear (both also undrained) and constant_p")
      ->check(is_at_least_zero());
  add("--strain", test.strain, "axial shortening over length, or shear displacement over height, at the end")
      ->check(is_from_to(-0.9, 0.9));
  add("--cycles", test.n_cycles, "load-unload cycles; 0 means loading only")->check(is_whole_from_to(0, 10'000));
}

}  // namespace

CLI::App* add_drive_command(CLI::App& app)
{
  CLI::App* command =
      app.add_subcommand("drive", "Take one material point along a path or through a laboratory test, as CSV");
  const auto options = std::make_shared<DriveArguments>();
  command->add_option("MATERIAL", options->material, "the material's JSON file")->required();
  CLI::Option* path = command->add_option(
      "PATH", options->path,
      "CSV (time,F11,F12,...,F33, or S11 and so on, stress in Pa, tension positive, in place of F11; shear may be left "
      "out), or prescribed-deformation text");
  add_test_options(*command, path, options->test);
  add_assignments(*command, options->assignments, "material");
  command->add_option("--increment", options->increment, "largest strain of an increment")
      ->check(is_from_to(1e-9, 0.1));
  command->add_option("--out", options->out, "write to this file")->type_name("FILE");
  command
      ->add_option("--plot", options->plot, "write a page with the curves of a laboratory test to this file, as HTML")
      ->type_name("FILE");
  CLI::Option* summary =
      command->add_option("--summary", options->summary, "write what the updates cost to this file, as JSON")
          ->type_name("FILE");
  command->add_option("--repeat", options->repeat, "rounds that the updates are timed in for --summary")
      ->check(is_whole_from_to(1, 1000))
      ->needs(summary);
  command->footer(examples(
      {{"tamp drive inputs/materials/concrete-sand/table.json path.csv --out answer.csv", "stresses along the path"},
       {"tamp drive inputs/materials/concrete-sand/table.json --test triaxial --pressure 200e3 --strain 0.15",
        "a drained triaxial test at 200 kPa"},
       {"tamp drive inputs/materials/concrete-sand/table.json --test oedometer --out answer.csv --plot answer.html",
        "its curves, for a browser"},
       {"tamp drive inputs/materials/concrete-sand/mlp.json path.csv --summary cost.json",
        "and what an update costs"}}));
  command->callback([options, command] {
    const std::string& test = options->test.name;
    if (options->path.empty() && test.empty()) throw CLI::RequiredError("PATH or --test");
    if (!test.empty()) check_test_options(*command, test);
    drive_point(*options);
  });
  return command;
}

}  // namespace tamp::tools
