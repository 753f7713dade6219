#include "tools/advice/measured_errors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "measured_errors_json.hpp"
#include "tools/scene/json/parse_json.hpp"

namespace tamp::tools
{

namespace
{

const Json& all_rows()
{
  static const Json rows = Json::parse(measured_errors_json);
  return rows;
}

std::string percent(double part)
{
  return fmt::format("{:.2g}", 100 * part);
}

std::string_view word_of(tasks::AntiLocking chosen)
{
  const auto words = words_of(chosen);
  return std::ranges::find(words, chosen, &components::Word<tasks::AntiLocking>::value)->word;
}

bool has_usual_rest(const tasks::Scene& scene)
{
  const tasks::Scene usual{};
  return scene.stress_timing == usual.stress_timing && scene.deformation_update == usual.deformation_update &&
         scene.local_damping == 0;
}

/// Whether a row is of the scene's method.
bool fits(const Json& row, const tasks::Scene& scene)
{
  const auto is = [&](const char* key, const Json& value) { return !row.contains(key) || row.at(key) == value; };
  const auto viscosity = scene.artificial_viscosity.value_or(components::ArtificialViscosity{0, 0});
  return is("interpolator", scene.interpolator.word()) && is("transfer", scene.transfer.word()) &&
         is("particles", scene.particles_per_axis) && is("viscosity", {viscosity.linear, viscosity.quadratic}) &&
         row.value("anti_locking", std::string("none")) == word_of(scene.anti_locking);
}

}  // namespace

std::string MeasuredError::text() const
{
  return least == greatest ? percent(least) + " %" : fmt::format("{} to {} %", percent(least), percent(greatest));
}

std::optional<MeasuredError> measured_error(const tasks::Scene& scene, const std::string& of, double cells)
{
  if (!has_usual_rest(scene)) return std::nullopt;
  constexpr double rounding = 1e-6;
  const Json *coarser = nullptr, *finer = nullptr;
  for (const Json& row : all_rows()) {
    if (row.at("of") != of || !fits(row, scene)) continue;
    const double there = row.at("cells");
    if (there <= cells * (1 + rounding) && (coarser == nullptr || there > coarser->at("cells"))) coarser = &row;
    if (there >= cells * (1 - rounding) && (finer == nullptr || there < finer->at("cells"))) finer = &row;
  }
  if (coarser == nullptr || finer == nullptr) return std::nullopt;
  const auto [least, greatest] = std::minmax({coarser->at("error").get<double>(), finer->at("error").get<double>()});
  return MeasuredError{least, greatest, finer->at("command")};
}

}  // namespace tamp::tools
