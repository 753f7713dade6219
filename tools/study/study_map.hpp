#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/study/findings.hpp"

namespace tamp::tools::study
{

/// How a run stands in a map.
enum class MapVerdict {
  stable,
  noisy,
  blown,   ///< far off, or never done
  refused  ///< a combination that the program does not take
};

std::string to_text(MapVerdict verdict);

/// A run in a map: its row and column, and the distance from the reference that decided, where it came to an answer.
struct MapCell {
  std::size_t row = 0, column = 0;
  int point = 0;
  MapVerdict verdict = MapVerdict::stable;
  std::optional<double> distance{};
};

/// The cells of a sheet, with the values of its rows and columns in the order in which they are listed.
struct MapOfSheet {
  const MapSheet* sheet;
  std::vector<Json> rows{}, columns{};
  std::vector<MapCell> cells{};
};

/// Sheets of a study's map, if it has one, whose points have been measured.
std::vector<MapOfSheet> map_of(const Study& study, const std::vector<MeasuredPoint>& points, const Findings& findings);

}  // namespace tamp::tools::study
