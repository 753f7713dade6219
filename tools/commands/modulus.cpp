#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <memory>
#include <nlohmann/json.hpp>

#include "components/materials/tabular_cap.hpp"
#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/commands.hpp"
#include "tools/run/modulus/modulus_states.hpp"
#include "tools/scene/files/file_kind.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/materials/read_material.hpp"
#include "tools/scene/materials/read_modulus.hpp"
#include "tools/scene/materials/read_network.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

struct ModulusArguments {
  std::string file;
  std::vector<std::string> at;
  std::vector<std::string> assignments;
  std::string scaling;
  std::optional<double> poisson_ratio;
  std::string states, out, summary;
};

struct AskedModel {
  components::Modulus modulus;
  double poisson_ratio;
  components::ElasticUpdate form;

  /// G / K
  double shear_ratio() const { return 1.5 * (1 - 2 * poisson_ratio) / (1 + poisson_ratio); }
};

/// Numbers separated by commas, as many as `n`.
std::vector<double> numbers(const std::string& option, const std::string& text, std::size_t n,
                            const std::string& expected)
{
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (true) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && *next != ',')) break;
    values.push_back(value);
    if (next == end) {
      if (values.size() != n) break;
      return values;
    }
    at = next + 1;
  }
  throw InputError({fmt::format("{} {}", option, text), fmt::format("not {} finite numbers", n), expected});
}

/// A material is JSON that says its type, or names a file that does.
bool is_material(const std::filesystem::path& file)
{
  if (file_kind(file) != FileKind::json) return false;
  const Json root = parse_json(file);
  return root.contains("type") || root.contains("file");
}

AskedModel model_of_material(const ModulusArguments& options)
{
  if (!options.scaling.empty()) {
    throw InputError({"--scaling", "given with a material", "expected --set /modulus/scaling=[...] there"});
  }
  const CheckedMaterial checked = read_checked_material(options.file, options.assignments);
  print_notes(checked.notes);
  print_warnings(checked.warnings);
  const tasks::SceneMaterial& material = checked.material;
  const auto* const sand = std::get_if<components::TabularCap>(&material.model);
  if (sand == nullptr) {
    throw InputError({options.file + "#/type", "a material without a model of its moduli", "expected tabular_cap"});
  }
  return {sand->parameters().modulus, options.poisson_ratio.value_or(sand->poisson_ratio()),
          sand->parameters().elastic_update};
}

AskedModel model_of_file(const ModulusArguments& options)
{
  if (!options.assignments.empty()) {
    throw InputError({"--set " + options.assignments.front(), "given with a model's file", "expected a material"});
  }
  std::optional<std::vector<double>> scaling;
  if (!options.scaling.empty()) {
    scaling = numbers("--scaling", options.scaling, 6, "expected mean_e,sd_e,mean_p,sd_p,mean_K,sd_K");
    check_scaling(*scaling, "--scaling");
  }
  return {read_model_file(options.file, scaling), options.poisson_ratio.value_or(0.189),
          components::ElasticUpdate::state};
}

AskedModel asked_model(const ModulusArguments& options)
{
  AskedModel model = is_material(options.file) ? model_of_material(options) : model_of_file(options);
  const double nu = model.poisson_ratio;
  if (!(nu > -1 && nu < 0.5)) {
    throw InputError({"--nu", fmt::format("{}", nu), "expected a number above -1 and below 0.5"});
  }
  return model;
}

void check_finite(const ModulusArguments& options, const std::string& at, const ModulusAnswer& answer)
{
  for (const auto& [name, value] : {std::pair{"p", answer.pressure}, std::pair{"K", answer.bulk_modulus},
                                    std::pair{"dK_dplastic", answer.modulus_by_plastic}}) {
    if (std::isfinite(value)) continue;
    throw InputError(
        {options.file, fmt::format("{} is {} at {}", name, value, at), "expected a model of finite values"});
  }
}

void print_moduli(const ModulusArguments& options)
{
  std::vector<std::vector<double>> states;
  for (const std::string& text : options.at) {
    states.push_back(numbers("--at", text, 2, "expected EE,EP, elastic and plastic volumetric strain"));
  }
  const AskedModel model = asked_model(options);
  print_out("{}\n", modulus_header());
  for (const std::vector<double>& state : states) {
    const ModulusAnswer answer = answer_at(model.modulus, components::ElasticUpdate::state, state[0], state[1]);
    check_finite(options, fmt::format("{},{}", state[0], state[1]), answer);
    print_out("{}\n", modulus_row(state[0], state[1], answer, model.shear_ratio()));
  }
}

void write_costs(const AskedModel& model, const ModulusStates& states, const std::filesystem::path& file)
{
  constexpr int n_rounds = 5;
  const ModulusCosts costs = modulus_costs(model.modulus, model.form, states, n_rounds);
  const nlohmann::ordered_json summary{
      {"evaluations", costs.n_evaluations}, {"ns_per_evaluation", costs.ns_per_evaluation}, {"bytes", costs.bytes}};
  write_output({"--summary", file}, json_text(summary, 2) + "\n");
}

void answer_states(const ModulusArguments& options)
{
  const ModulusStates states = read_modulus_states(options.states);
  const AskedModel model = asked_model(options);
  expect_outputs({{"--out", options.out}, {"--summary", options.summary}});
  const std::string table = modulus_table(model.modulus, model.form, model.shear_ratio(), states);
  if (options.out.empty()) {
    print_out("{}", table);
  } else {
    write_output({"--out", options.out}, table);
  }
  if (!options.summary.empty()) write_costs(model, states, options.summary);
}

void answer(const ModulusArguments& options)
{
  if (!options.states.empty()) return answer_states(options);
  if (options.at.empty()) throw CLI::RequiredError("--at or --states");
  print_moduli(options);
}

}  // namespace

CLI::App* add_modulus_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("modulus", "Print the pressure and moduli of a material or model file");
  const auto options = std::make_shared<ModulusArguments>();
  command
      ->add_option("FILE", options->file,
                   "a material (JSON), or a model: unloading curves (CSV), a published table or support-vector "
                   "regression (JSON), a Keras network (HDF5)")
      ->required();
  CLI::Option* at = command
                        ->add_option("--at", options->at,
                                     "elastic and plastic volumetric strain, compression positive, may be repeated")
                        ->type_name("EE,EP")
                        ->allow_extra_args(false);
  CLI::Option* states =
      command
          ->add_option("--states", options->states,
                       "CSV (elastic_volumetric[-],plastic_volumetric[-], with pressure[Pa],bulk_modulus[Pa] where "
                       "measured): answers in the form of the material's elastic_update, and how far they are off")
          ->excludes(at);
  command->add_option("--out", options->out, "write what --states answers to this file")
      ->type_name("FILE")
      ->needs(states);
  command->add_option("--summary", options->summary, "write what an evaluation of --states costs to this file, as JSON")
      ->needs(states);
  add_assignments(*command, options->assignments, "material");
  command->add_option("--nu", options->poisson_ratio, "Poisson's ratio; the material's, or 0.189 for a model's file");
  command->add_option("--scaling", options->scaling,
                      "mean_e,sd_e,mean_p,sd_p,mean_K,sd_K: what a network's file was standardised with, if not in it");
  command->footer(
      examples({{"tamp modulus inputs/materials/concrete-sand/table.json --at 0.01,0 --at 0.02,0.01", "two states"},
                {"tamp modulus inputs/materials/concrete-sand/mlp.json --states states.csv --out answers.csv",
                 "a table of states"}}));
  command->callback([options] { answer(*options); });
  return command;
}

}  // namespace tamp::tools
