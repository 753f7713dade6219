#pragma once

#include <optional>
#include <string>

#include "tools/study/limit/limit_search.hpp"
#include "tools/study/run_study.hpp"

namespace tamp::tools::study
{

/// Options of `tamp study --limit`.
struct LimitOptions {
  /// The setting, a JSON pointer to a number of the scene; empty where no limit is asked for.
  std::string pointer;
  LimitSearch search;
  /// Overrides that of the study.
  std::optional<double> energy_error{};
};

/// Looks for the value of a setting at which each method of a study, or a scene, stops being stable, and writes
/// `limit.json` and `limit.csv`. Methods that sweep the setting have a limit for each of their other combinations;
/// where there are none, each method has one, with the first values of its sweep. Throws InputError before anything
/// runs, and after all is written where a method has no limit.
void find_limits(const StudyOptions& options, const LimitOptions& limit);

}  // namespace tamp::tools::study
