#include "tools/scene/materials/compare_modulus.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <vector>

#include "tools/scene/materials/unloading_curves.hpp"

namespace tamp::tools
{

namespace
{

using components::PiecewiseLinear;

/// A state of the sand, and its pressure by a table and by the modulus.
struct State {
  double elastic, plastic, tabulated, modelled = 0;

  double ratio() const { return std::max(1e-99, modelled / tabulated); }
  /// The factor by which the modelled pressure is off, 1 or more.
  double off() const { return std::max(ratio(), 1 / ratio()); }
};

/// Curves of states, from a table that has a name for people.
struct Tabulated {
  std::string name;
  std::vector<std::vector<State>> curves;
};

/// A curve for each plastic strain.
Tabulated unloading_states(const std::filesystem::path& file, StrainMeasure measure)
{
  const Table table = read_unloading_curves(file, measure);
  Tabulated unloading{file.string(), {}};
  const std::vector<double>&plastic = table.columns[0], &elastic = table.columns[1], &pressure = table.columns[2];
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    if (i == 0 || plastic[i] != plastic[i - 1]) unloading.curves.emplace_back();
    if (pressure[i] > 0) unloading.curves.back().push_back({elastic[i], plastic[i], pressure[i]});
  }
  return unloading;
}

/// The total strain at which the hydrostat comes to a pressure; none where it does not.
std::optional<double> total_strain_at(double pressure, const PiecewiseLinear& hydrostat)
{
  const auto at = std::lower_bound(hydrostat.y().begin(), hydrostat.y().end(), pressure);
  if (at == hydrostat.y().begin() || at == hydrostat.y().end()) return std::nullopt;
  const auto i = static_cast<std::size_t>(at - hydrostat.y().begin());
  const double part = (pressure - hydrostat.y()[i - 1]) / (hydrostat.y()[i] - hydrostat.y()[i - 1]);
  return std::lerp(hydrostat.x()[i - 1], hydrostat.x()[i], part);
}

/// The states along the loading, as one curve.
Tabulated loading_states(const PiecewiseLinear& crush_curve, const PiecewiseLinear& hydrostat)
{
  constexpr int n_states = 32;
  Tabulated loading{"the crush curve and the hydrostat", {{}}};
  const double first = std::max(0.0, crush_curve.x().front()), last = crush_curve.x().back();
  for (int i = 0; i < n_states; ++i) {
    const double plastic = std::lerp(first, last, (i + 0.5) / n_states), pressure = crush_curve(plastic);
    const auto total = total_strain_at(pressure, hydrostat);
    if (total && *total > plastic && pressure > 0) {
      loading.curves.front().push_back({*total - plastic, plastic, pressure});
    }
  }
  return loading;
}

/// The states in the tables beside the modulus; where these cannot be read, a remark is made.
Tabulated tabulated(JsonReader& material, StrainMeasure measure, const LoadingCurves& loading)
{
  Document& document = material.document();
  const Json& modulus = document.root.at(material.pointer("modulus"));
  const std::string key(components::UnloadingTable::type);
  if (modulus.contains(key) && modulus.at(key).is_string()) {
    try {
      return unloading_states(modulus.at(key).get<std::string>(), measure);
    } catch (const std::runtime_error& error) {
      document.remarks.push_back(fmt::format("{}: not compared with its unloading curves: {}",
                                             material.pointer("modulus").to_string(), error.what()));
    }
  }
  if (loading.crush_curve && loading.hydrostat) return loading_states(*loading.crush_curve, *loading.hydrostat);
  return {};
}

/// The state with the median error of its curve: half of the others are off by less.
State median(std::vector<State> curve, const components::Modulus& modulus)
{
  for (State& s : curve) {
    s.modelled = std::visit([&](const auto& model) { return model.at(s.elastic, s.plastic).pressure; }, modulus);
  }
  const auto middle = curve.begin() + static_cast<std::ptrdiff_t>(curve.size() / 2);
  std::nth_element(curve.begin(), middle, curve.end(),
                   [](const State& a, const State& b) { return a.ratio() < b.ratio(); });
  return *middle;
}

/// The likely cause of a fit that is off by this factor, in words.
std::string likely_cause(const std::string& type, double ratio)
{
  const double decades = std::abs(std::log10(ratio));
  for (const auto& [unit, decades_of_unit] : {std::pair{"kPa", 3}, {"MPa", 6}, {"GPa", 9}}) {
    if (std::abs(decades - decades_of_unit) > 0.35) continue;
    return ratio < 1 ? fmt::format("pressures in {} that are read as Pa", unit)
                     : fmt::format("pressures in Pa that are read as {}", unit);
  }
  if (type == components::NetworkModulus::type) {
    return "other units, a scaling that is inverted or left out, or variances for deviations";
  }
  return "other units, or a scale or conversion factor that is inverted or left at 1";
}

}  // namespace

void compare_with_tables(JsonReader& material, const components::Modulus& modulus, StrainMeasure measure,
                         const LoadingCurves& loading)
{
  Document& document = material.document();
  const JsonPointer place = material.pointer("modulus");
  const std::string type = document.root.at(place / "type").get<std::string>();
  if (type == components::UnloadingTable::type) return;

  const Tabulated beside = tabulated(material, measure, loading);
  std::optional<State> worst;
  for (const std::vector<State>& curve : beside.curves) {
    if (curve.empty()) continue;
    const State middle = median(curve, modulus);
    if (!worst || middle.off() > worst->off()) worst = middle;
  }
  constexpr double much = 3, some = 1.3;
  if (!worst || worst->off() < some) return;
  const std::string text = fmt::format(
      "{}: \"{}\" has {:.2g} times the pressure of {}: {:.3g} Pa, not {:.3g}, at elastic strain {:.2g} and plastic "
      "strain {:.2g}",
      place.to_string(), type, worst->ratio(), beside.name, worst->modelled, worst->tabulated, worst->elastic,
      worst->plastic);
  if (worst->off() > much) {
    document.warnings.push_back(text + "; likely " + likely_cause(type, worst->ratio()));
  } else {
    document.remarks.push_back(text);
  }
}

}  // namespace tamp::tools
