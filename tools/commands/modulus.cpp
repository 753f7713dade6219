#include <fmt/core.h>

#include <charconv>
#include <cmath>
#include <memory>

#include "components/materials/tabular_cap.hpp"
#include "tools/commands/commands.hpp"
#include "tools/console.hpp"
#include "tools/errors.hpp"
#include "tools/scene/file_kind.hpp"
#include "tools/scene/parse_json.hpp"
#include "tools/scene/read_material.hpp"
#include "tools/scene/read_modulus.hpp"
#include "tools/scene/read_network.hpp"

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
};

struct AskedModel {
  components::Modulus modulus;
  double poisson_ratio;
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
  const tasks::SceneMaterial material = read_material_file(options.file, options.assignments);
  const auto* const sand = std::get_if<components::TabularCap>(&material.model);
  if (sand == nullptr) {
    throw InputError({options.file + "#/type", "a material without a model of its moduli", "expected tabular_cap"});
  }
  return {sand->parameters().modulus, options.poisson_ratio.value_or(sand->poisson_ratio())};
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
  return {read_model_file(options.file, scaling), options.poisson_ratio.value_or(0.189)};
}

void print_moduli(const ModulusArguments& options)
{
  std::vector<std::vector<double>> states;
  for (const std::string& text : options.at) {
    states.push_back(numbers("--at", text, 2, "expected EE,EP, elastic and plastic volumetric strain"));
  }
  const AskedModel model = is_material(options.file) ? model_of_material(options) : model_of_file(options);
  const double nu = model.poisson_ratio;
  if (!(nu > -1 && nu < 0.5)) {
    throw InputError({"--nu", fmt::format("{}", nu), "expected a number above -1 and below 0.5"});
  }
  const double shear_ratio = 1.5 * (1 - 2 * nu) / (1 + nu);

  print_out("elastic_v[-],plastic_v[-],p[Pa],K[Pa],G[Pa],dK_dplastic[Pa],in_range\n");
  for (const std::vector<double>& state : states) {
    const double elastic = state[0], plastic = state[1];
    std::visit(
        [&](const auto& modulus) {
          const components::ElasticPoint point = modulus.at(elastic, plastic);
          print_out("{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:d}\n", elastic, plastic, point.pressure,
                    point.bulk_modulus, shear_ratio * point.bulk_modulus, modulus.modulus_by_plastic(elastic, plastic),
                    modulus.in_range(elastic, plastic));
        },
        model.modulus);
  }
}

}  // namespace

CLI::App* add_modulus_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand(
      "modulus", "Ask a material, or a model's file by itself, for pressure and moduli at given strains, as CSV");
  const auto options = std::make_shared<ModulusArguments>();
  command
      ->add_option("FILE", options->file,
                   "a material (JSON), or a model: unloading curves (CSV), a published table or support-vector "
                   "regression (JSON), a Keras network (HDF5)")
      ->required();
  command
      ->add_option("--at", options->at,
                   "EE,EP: elastic and plastic volumetric strain, compression positive, may be repeated")
      ->required()
      ->allow_extra_args(false);
  command->add_option("--set", options->assignments, "POINTER=VALUE: replace a value of the material, may be repeated")
      ->allow_extra_args(false);
  command->add_option("--nu", options->poisson_ratio, "Poisson's ratio; the material's, or 0.189 for a model's file");
  command->add_option("--scaling", options->scaling,
                      "mean_e,sd_e,mean_p,sd_p,mean_K,sd_K: what a network's file was standardised with, if not in it");
  command->callback([options] { print_moduli(*options); });
  return command;
}

}  // namespace tamp::tools
