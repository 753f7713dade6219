#include "tools/study/study_map_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/scene/json/print_json.hpp"
#include "tools/scene/tables/csv_text.hpp"

namespace tamp::tools::study
{

Json map_to_json(const StudyResults& results)
{
  if (!results.study.map) return nullptr;
  const StudyMap& map = *results.study.map;
  Json sheets = Json::array();
  for (const MapOfSheet& one : results.map) {
    Json cells = Json::array();
    for (const MapCell& cell : one.cells) {
      cells.push_back({{"row", cell.row},
                       {"column", cell.column},
                       {"point", cell.point},
                       {"verdict", to_text(cell.verdict)},
                       {"distance", or_null(cell.distance)}});
    }
    sheets.push_back({{"name", one.sheet->name},
                      {"rows", one.sheet->rows},
                      {"rows_name", pointer_name(one.sheet->rows)},
                      {"columns", one.sheet->columns},
                      {"columns_name", pointer_name(one.sheet->columns)},
                      {"row_values", one.rows},
                      {"column_values", one.columns},
                      {"bound", or_null(one.sheet->bound)},
                      {"cells", cells}});
  }
  return {{"quantity", map.quantity}, {"noisy", map.noisy}, {"blown", map.blown}, {"sheets", sheets}};
}

std::string map_to_csv(const StudyResults& results)
{
  std::vector<CsvRow> rows;
  for (const MapOfSheet& one : results.map) {
    for (const MapCell& cell : one.cells) {
      const auto point = static_cast<std::size_t>(cell.point) - 1;
      rows.push_back({{"sheet", one.sheet->name},
                      {"rows", one.sheet->rows},
                      {"row", one.rows[cell.row]},
                      {"columns", one.sheet->columns},
                      {"column", one.columns[cell.column]},
                      {"is", to_text(cell.verdict)},
                      {"distance", or_null(cell.distance)},
                      {"reason", results.points[point].result.reason},
                      {"command", command_text(results.measurements[point])}});
    }
  }
  return csv_text(rows);
}

std::string map_to_text(const StudyResults& results)
{
  std::string text;
  for (const MapOfSheet& one : results.map) {
    const auto n = [&](MapVerdict verdict) {
      return std::count_if(one.cells.begin(), one.cells.end(), [=](const MapCell& c) { return c.verdict == verdict; });
    };
    text += fmt::format("  {}: {} runs: {} stable, {} noisy, {} blown, {} refused\n", one.sheet->name, one.cells.size(),
                        n(MapVerdict::stable), n(MapVerdict::noisy), n(MapVerdict::blown), n(MapVerdict::refused));
  }
  return text;
}

}  // namespace tamp::tools::study
