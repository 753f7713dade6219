#include "tools/scene/materials/read_material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "components/errors.hpp"
#include "components/materials/tabular_cap.hpp"
#include "tools/scene/json/parameter_keys.hpp"
#include "tools/scene/materials/compare_modulus.hpp"
#include "tools/scene/materials/read_modulus.hpp"
#include "tools/scene/materials/strain_measure.hpp"
#include "tools/scene/materials/yield_table.hpp"
#include "tools/scene/tables/table.hpp"

namespace tamp::tools
{

namespace
{

using components::BadValue;

/// A table and what was made from it. Problems of either are the document's.
template <class Make>
auto from_table(JsonReader& reader, const std::string& key, const std::vector<std::string>& columns, Make make)
    -> std::optional<decltype(make(std::declval<Table&>()))>
{
  const std::filesystem::path file = reader.existing_file(key);
  if (file.empty()) return std::nullopt;
  return noting_problems(reader.document(), [&] {
    Table table = read_table(file, columns);
    return made_from(table, make);
  });
}

/// A curve whose abscissa is a total or a plastic strain.
components::PiecewiseLinear curve_of_strain(Table& table, StrainMeasure measure)
{
  convert_to_logarithmic(table, 0, measure);
  return {std::move(table.columns[0]), std::move(table.columns[1])};
}

std::optional<components::YieldSurface> read_yield(JsonReader& material)
{
  JsonReader reader = material.object("yield");
  const std::size_t before = reader.document().problems.size();
  std::optional<YieldMeasure> measure;
  if (reader.has("measure")) measure = reader.choice<YieldMeasure>("measure");
  const std::filesystem::path file = reader.existing_file("file");
  if (reader.document().problems.size() > before || file.empty()) return std::nullopt;
  double ellipticity = reader.number("cap_ellipticity");
  constexpr double any_ellipticity = 0.5;
  if (reader.document().problems.size() > before) ellipticity = any_ellipticity;
  reader.finish();
  return noting_problems(reader.document(), [&] {
    YieldTable yield = read_yield_table(file, measure, reader.place("measure"));
    components::YieldSurface surface = made_from(
        yield.table, [&](Table& t) { return components::YieldSurface(t.columns[0], t.columns[1], ellipticity); });
    for (std::string& line : yield.lifted_by(surface)) reader.document().remarks.push_back(std::move(line));
    return surface;
  });
}

/// X(plastic strain), and the table it came from where it did.
struct CrushCurve {
  components::PiecewiseLinear curve;
  std::optional<Table> table;
};

std::optional<CrushCurve> read_tabulated_crush_curve(JsonReader& reader, StrainMeasure measure)
{
  return from_table(reader, "crush_curve", {"plastic_volumetric[-]", "pressure[Pa]"}, [&](Table& table) {
    Table kept = table;
    return CrushCurve{curve_of_strain(table, measure), std::move(kept)};
  });
}

/// The tables of a loading that compacts the sand.
struct LoadingTables {
  std::optional<components::PiecewiseLinear> hydrostat;
  std::optional<CrushCurve> crush_curve;

  LoadingCurves curves() const { return {hydrostat, crush_curve ? std::optional(crush_curve->curve) : std::nullopt}; }
};

/// In the state form the crush curve follows from the modulus and the hydrostat. In the rate form it is tabulated. The
/// table that is not needed may be left out; it is read only to be checked.
LoadingTables read_loading(JsonReader& reader, components::ElasticUpdate update, StrainMeasure measure)
{
  const bool state_form = update == components::ElasticUpdate::state;
  LoadingTables loading;
  if (state_form || reader.has("hydrostat")) {
    loading.hydrostat = from_table(reader, "hydrostat", {"total_volumetric[-]", "pressure[Pa]"},
                                   [&](Table& table) { return curve_of_strain(table, measure); });
  }
  if (!state_form || reader.has("crush_curve")) loading.crush_curve = read_tabulated_crush_curve(reader, measure);
  return loading;
}

std::optional<CrushCurve> crush_curve_of(const LoadingTables& loading, components::ElasticUpdate update,
                                         const std::optional<components::Modulus>& modulus, const JsonReader& reader)
{
  if (update != components::ElasticUpdate::state) return loading.crush_curve;
  if (!modulus || !loading.hydrostat) return std::nullopt;
  try {
    return CrushCurve{components::consistent_crush_curve(*modulus, *loading.hydrostat), std::nullopt};
  } catch (const BadValue& bad) {
    reader.add_problem("hydrostat", bad.found, "expected " + bad.expected);
    return std::nullopt;
  }
}

/// Checks the keys of the tests; their values are for material_warnings (plausibility.hpp) alone.
void check_tests(JsonReader& reader)
{
  reader.optional_number("tested_density");
  if (reader.has("tested_strain")) reader.choice<StrainMeasure>("tested_strain");
}

std::optional<tasks::MaterialModel> read_tabular_cap(JsonReader& reader)
{
  std::vector<Problem>& problems = reader.document().problems;
  const std::size_t n_before = problems.size();
  const double poisson_ratio = reader.number("poisson_ratio");
  const auto update = reader.choice<components::ElasticUpdate>("elastic_update");
  const double tolerance = reader.number("tolerance");
  const int max_substeps = reader.whole_number("max_substeps");
  const bool separates = reader.flag("separation");
  const double separation_density = reader.number("separation_density");
  const std::optional<double> dilation_limit = reader.optional_number("dilation_limit");
  const bool gaps = reader.flag("gaps");
  if (gaps && separates) {
    reader.add_problem("gaps", "true with separation", "expected one of the two: gaps separate at any density");
  }
  const auto measure = reader.choice<StrainMeasure>("strain_measure");
  check_tests(reader);
  const auto modulus = read_modulus(reader, measure);
  const auto yield = read_yield(reader);
  const LoadingTables loading = read_loading(reader, update, measure);
  const auto crush = crush_curve_of(loading, update, modulus, reader);
  if (problems.size() > n_before || !modulus || !yield || !crush) return std::nullopt;
  compare_with_tables(reader, *modulus, measure, loading.curves());
  try {
    return components::TabularCap({poisson_ratio, update, *modulus, crush->curve, *yield, tolerance, max_substeps,
                                   separates ? std::optional(separation_density) : std::nullopt, dilation_limit, gaps});
  } catch (const BadValue& bad) {
    // All but the crush curve was checked above.
    if (crush->table) {
      problems.push_back(crush->table->problem(bad.row, bad.found, "expected " + bad.expected));
    } else {
      reader.add_problem("hydrostat", bad.found, "expected " + bad.expected);
    }
    return std::nullopt;
  }
}

/// Facts that a model needs about the scene and the rest of its material.
struct Surroundings {
  double density;
  bool density_is_good;
  bool in_plane_strain;
};

/// The density that a sand has been given, or that which it has at the relative density that it has been given; it
/// adds a remark on the packing.
double density_of(JsonReader& reader, const components::BoltonSand& sand, double density)
{
  const double loosest = sand.e_max, range = sand.e_max - sand.e_min;
  if (const std::optional<double> relative = reader.optional_number("relative_density")) {
    const double own = sand.grain_density / (1 + loosest - *relative * range);
    density = reader.number("density", own);
    constexpr double round_off = 1e-6;
    if (std::abs(density / own - 1) > round_off) {
      reader.add_problem("relative_density", fmt::format("{} beside a density of {}", *relative, density),
                         fmt::format("expected one of the two, or {:.6g} kg/m^3", own));
    }
    density = own;
  }
  const double void_ratio = sand.grain_density / density - 1;
  reader.document().remarks.push_back(
      fmt::format("{}: {:.5g} kg/m3, a void ratio of {:.3g}, a relative density of {:.2f}", reader.place("density"),
                  density, void_ratio, (loosest - void_ratio) / range));
  return density;
}

/// A model that consists of numbers.
template <class Model>
std::optional<tasks::MaterialModel> read_model(JsonReader& reader, const Surroundings& around)
{
  const std::size_t n_problems = reader.document().problems.size();
  Model model{};
  read_parameters(reader, model);
  if (reader.document().problems.size() > n_problems || !around.density_is_good) return std::nullopt;
  try {
    if constexpr (requires { model.check(); }) model.check();
    if constexpr (requires { model.fill(around.density); }) model.fill(density_of(reader, model, around.density));
    if constexpr (requires { model.choose_strength(true); }) model.choose_strength(around.in_plane_strain);
  } catch (const components::BadParameter& bad) {
    reader.add_problem(bad.key, bad.found, "expected " + bad.expected);
    return std::nullopt;
  }
  return model;
}

template <>
std::optional<tasks::MaterialModel> read_model<components::TabularCap>(JsonReader& reader, const Surroundings&)
{
  return read_tabular_cap(reader);
}

/// Reads the model among those of a variant whose type it is.
template <class... Model>
std::optional<tasks::MaterialModel> read_model(const std::string& type, JsonReader& reader, const Surroundings& around,
                                               const std::variant<Model...>*)
{
  std::optional<tasks::MaterialModel> model;
  ((type == Model::type ? void(model = read_model<Model>(reader, around)) : void()), ...);
  return model;
}

}  // namespace

std::optional<tasks::SceneMaterial> read_material(const std::string& name, JsonReader reader, bool in_plane_strain)
{
  reader.expect_numbers_to_multiply();
  const std::string type = reader.type();
  if (type.empty()) return std::nullopt;
  const bool is_relative = type == components::BoltonSand::type && reader.has("relative_density");
  const std::size_t n_before = reader.document().problems.size();
  double density = is_relative ? 0 : reader.number("density");
  const Surroundings around{density, reader.document().problems.size() == n_before, in_plane_strain};
  const auto model = read_model(type, reader, around, static_cast<const tasks::MaterialModel*>(nullptr));
  if (is_relative && model) density = reader.number("density");
  std::optional<int> particles_per_axis;
  if (reader.has("particles_per_axis")) particles_per_axis = reader.whole_number("particles_per_axis");
  reader.finish();
  if (!model) return std::nullopt;
  return tasks::SceneMaterial{name, density, *model, particles_per_axis};
}

CheckedMaterial read_checked_material(const std::filesystem::path& file, const std::vector<std::string>& assignments)
{
  Document document(file, material_keys());
  for (const std::string& assignment : assignments) document.set(assignment);
  document.merge_file_named_at(JsonPointer(), material_keys());
  auto material = read_material(file.stem().string(), JsonReader(document, material_keys()));
  if (!document.problems.empty()) throw InputError(std::move(document.problems));
  document.root["inputs"] = to_json(document.inputs);
  return {std::move(*material), std::move(document.root), std::move(document.notes), std::move(document.warnings)};
}

}  // namespace tamp::tools
