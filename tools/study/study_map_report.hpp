#pragma once

#include "tools/study/study_report.hpp"

namespace tamp::tools::study
{

/// The map in `study.json`; null where the study has none.
Json map_to_json(const StudyResults& results);
/// `map.csv`: a row for each cell.
std::string map_to_csv(const StudyResults& results);
/// For a person at a terminal: what each sheet counts.
std::string map_to_text(const StudyResults& results);

}  // namespace tamp::tools::study
