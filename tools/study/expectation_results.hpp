#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/study/findings.hpp"

namespace tamp::tools::study
{

/// Whether what was expected of one method holds.
struct ExpectationResult {
  std::string quantity, method;
  /// The method, and what distinguishes its points from others of it that were refined on their own.
  std::string label;
  Expectation::Kind kind = Expectation::Kind::error_at_most;
  double limit = 0;
  bool holds = false;
  /// The order or the error; empty where there is none.
  std::optional<double> found{};
  /// For people: "order at least 1.95", "order 2.01", and the reason.
  std::string expected{}, note{}, why{};
  /// Why it is known not to hold; empty where it is to hold.
  std::string missed{};
};

/// In a word or two: whether it holds, and whether that is as the study has it.
std::string verdict(const ExpectationResult& result);

/// Judges every expectation of a study for each of its methods. The order is the slope of log(error) over log(refined
/// setting), by least squares through all points, three at least, whether errors fall from each to the next or not; a
/// method with a point that came to no answer has none, and misses every bar but `fails`.
std::vector<ExpectationResult> judge_expectations(const Study& study, const std::vector<MeasuredPoint>& points,
                                                  const Findings& findings);

/// As the study's file has it: "order_at_least".
std::string to_text(Expectation::Kind kind);

}  // namespace tamp::tools::study
