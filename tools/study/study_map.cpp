#include "tools/study/study_map.hpp"

#include <algorithm>
#include <array>

namespace tamp::tools::study
{

namespace
{

const QuantityFindings& findings_of_map(const Study& study, const Findings& findings)
{
  const auto quantity = std::find_if(study.quantities.begin(), study.quantities.end(),
                                     [&](const Quantity& one) { return one.name == study.map->quantity; });
  return findings.quantities.at(static_cast<std::size_t>(quantity - study.quantities.begin()));
}

std::size_t place_of(const Json& value, std::vector<Json>& values)
{
  const auto at = std::find(values.begin(), values.end(), value);
  if (at != values.end()) return static_cast<std::size_t>(at - values.begin());
  values.push_back(value);
  return values.size() - 1;
}

MapVerdict verdict_of(const StudyMap& map, const MeasuredPoint& one, const std::optional<double>& distance)
{
  if (one.result.end == End::refused) return MapVerdict::refused;
  if (!one.done() || !distance || *distance >= map.blown) return MapVerdict::blown;
  return *distance >= map.noisy ? MapVerdict::noisy : MapVerdict::stable;
}

MapOfSheet cells_of(const Study& study, const MapSheet& sheet, const std::vector<MeasuredPoint>& points,
                    const QuantityFindings& found)
{
  MapOfSheet all{&sheet};
  for (const MeasuredPoint& one : points) {
    const auto is_of_sheet = std::count(sheet.methods.begin(), sheet.methods.end(), one.point.method) > 0;
    const Json row = one.point.setting(sheet.rows), column = one.point.setting(sheet.columns);
    if (!is_of_sheet || row.is_null() || column.is_null()) continue;
    MapCell cell{place_of(row, all.rows), place_of(column, all.columns), one.point.id};
    const auto error = found.errors.find(one.point.id);
    if (error != found.errors.end()) cell.distance = error->second;
    cell.verdict = verdict_of(*study.map, one, cell.distance);
    all.cells.push_back(cell);
  }
  return all;
}

}  // namespace

std::string to_text(MapVerdict verdict)
{
  static constexpr std::array<const char*, 4> words{"stable", "noisy", "blown", "refused"};
  return words.at(static_cast<std::size_t>(verdict));
}

std::vector<MapOfSheet> map_of(const Study& study, const std::vector<MeasuredPoint>& points, const Findings& findings)
{
  std::vector<MapOfSheet> sheets;
  if (!study.map) return sheets;
  const QuantityFindings& found = findings_of_map(study, findings);
  for (const MapSheet& sheet : study.map->sheets) sheets.push_back(cells_of(study, sheet, points, found));
  return sheets;
}

}  // namespace tamp::tools::study
