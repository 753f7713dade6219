#include "tools/scene/yield_table.hpp"

#include <fmt/core.h>

#include <cmath>

#include "tools/scene/csv_table.hpp"
#include "tools/scene/file_kind.hpp"
#include "tools/scene/published_table.hpp"

namespace tamp::tools
{

namespace
{

void convert_to_sqrt_j2(Table& table, YieldMeasure measure)
{
  if (measure == YieldMeasure::sqrt_J2) return;
  for (double& strength : table.columns[1]) strength /= std::sqrt(3.0);
}

}  // namespace

Table read_yield_table(const std::filesystem::path& file, std::optional<YieldMeasure> stated,
                       const std::string& place_of_measure)
{
  if (file_kind(file) == FileKind::json) {
    if (!stated) {
      throw InputError({place_of_measure, "missing",
                        "expected \"q\" or \"sqrt_J2\": a published table calls its column SqrtJ2 whichever it holds"});
    }
    Table table = read_published_curve(file, {"pressure[Pa]", "sqrt_J2[Pa]"});
    convert_to_sqrt_j2(table, *stated);
    return table;
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
  return std::move(table);
}

}  // namespace tamp::tools
