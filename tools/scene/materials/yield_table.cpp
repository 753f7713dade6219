#include "tools/scene/materials/yield_table.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tools/scene/files/digits.hpp"
#include "tools/scene/files/file_kind.hpp"
#include "tools/scene/tables/csv_table.hpp"
#include "tools/scene/tables/published_table.hpp"

namespace tamp::tools
{

namespace
{

void convert_to_sqrt_j2(Table& table, YieldMeasure measure)
{
  if (measure == YieldMeasure::sqrt_J2) return;
  for (double& strength : table.columns[1]) strength /= std::sqrt(3.0);
}

/// The factor of sqrt(J2) in the measure.
double unit_of(YieldMeasure measure)
{
  return measure == YieldMeasure::q ? std::sqrt(3.0) : 1;
}

}  // namespace

std::vector<std::string> YieldTable::lifted_by(const components::YieldSurface& surface) const
{
  constexpr double noted = 0.02;
  std::vector<std::string> lines;
  for (std::size_t i = 0; i < table.n_rows(); ++i) {
    const double pressure = table.columns[0][i], measured = table.columns[1][i];
    const double used = surface.strength(pressure).value;
    if (used <= (1 + noted) * measured) continue;
    const std::string by = measured > 0 ? fmt::format(" by {} %", two_digits(100 * (used / measured - 1))) : "";
    lines.push_back(
        fmt::format("{}: lifted{} to the concave hull of the table: at {:.6g} Pa {} is {:.6g} Pa as "
                    "measured, {:.6g} Pa as used",
                    table.place_of_row[i], by, pressure, measure == YieldMeasure::q ? "q" : "sqrt(J2)",
                    unit_of(measure) * measured, unit_of(measure) * used));
  }
  return lines;
}

YieldTable read_yield_table(const std::filesystem::path& file, std::optional<YieldMeasure> stated,
                            const std::string& place_of_measure)
{
  if (file_kind(file) == FileKind::json) {
    if (!stated) {
      throw InputError({place_of_measure, "missing",
                        "expected \"q\" or \"sqrt_J2\": a published table calls its column SqrtJ2 whichever it holds"});
    }
    Table table = read_published_curve(file, {"pressure[Pa]", "sqrt_J2[Pa]"});
    convert_to_sqrt_j2(table, *stated);
    return {std::move(table), *stated};
  }
  // In the order of YieldMeasure.
  const std::vector<std::vector<std::string>> headings{{"pressure[Pa]", "q[Pa]"}, {"pressure[Pa]", "sqrt_J2[Pa]"}};
  auto [table, heading] = read_csv_table(file, headings);
  const auto measure = static_cast<YieldMeasure>(heading);
  if (stated && *stated != measure) {
    throw InputError({place_of_measure, *stated == YieldMeasure::q ? "\"q\"" : "\"sqrt_J2\"",
                      fmt::format("expected none, or what {} has in its heading, {}", file.filename().string(),
                                  headings[heading][1])});
  }
  convert_to_sqrt_j2(table, measure);
  return {std::move(table), measure};
}

}  // namespace tamp::tools
