#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tools/study/expectation_results.hpp"
#include "tools/study/findings.hpp"
#include "tools/study/measurement.hpp"
#include "tools/study/study_map.hpp"

namespace tamp::tools::study
{

/// The data that a report of a study is made from.
struct StudyResults {
  const Study& study;
  /// The command line that remakes all of it.
  std::string command;
  std::vector<MeasuredPoint> points;
  /// The measurement of each point.
  std::vector<Measurement> measurements;
  Findings findings;
  std::vector<ExpectationResult> expectations;
  std::vector<MapOfSheet> map{};
};

/// `study.json`, which the page is drawn from, see docs/how_to/study.md.
Json to_json(const StudyResults& results);

/// `points.csv`: a row for each point.
std::string to_csv(const StudyResults& results);

/// `gates.csv`: a row for each expectation of each method.
std::string expectations_to_csv(const StudyResults& results);

/// For a person at a terminal: each quantity's reference, its Pareto front, the error budgets, and what was expected.
std::string to_text(const StudyResults& results);

}  // namespace tamp::tools::study
