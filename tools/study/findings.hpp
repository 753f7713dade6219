#pragma once

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "tools/study/error_budget.hpp"
#include "tools/study/reference.hpp"

namespace tamp::tools::study
{

/// How a method's errors fall along the refined setting, its other settings the same.
struct OrderFit {
  std::string method, label;
  /// Ids of the points, from coarse to fine.
  std::vector<int> points;
  /// Empty where errors do not fall, or there are fewer than three.
  std::optional<double> order;
  /// The power of the first refined setting with which the cost grows: -3 where half the setting costs eight times as
  /// much.
  std::optional<double> cost_power;
  std::string note;
};

/// The findings on one quantity.
struct QuantityFindings {
  Reference reference;
  /// Values and errors of the points that are done, by point id. Errors are distances from the reference.
  std::map<int, double> values, errors;
  /// Ids of the points of `errors` whose distance is no error, only a difference: the reference has no bound, or the
  /// point models something else. They are on no front and have no order.
  std::set<int> differences;
  /// Ids of the points of the charts on the Pareto front: no other is both cheaper and better.
  std::vector<int> front;
  std::vector<OrderFit> orders;
};

struct Findings {
  /// The findings on each quantity of the study.
  std::vector<QuantityFindings> quantities;
  std::vector<ErrorBudget> budgets;
};

/// The points of each method, and of the reference, that differ in the refined setting alone, from coarse to fine.
std::vector<std::vector<const MeasuredPoint*>> refined_groups(const Study& study,
                                                              const std::vector<MeasuredPoint>& points);

/// Errors, orders, Pareto fronts and error budgets of a study whose points have been measured.
Findings findings_of(const Study& study, const std::vector<MeasuredPoint>& points);

}  // namespace tamp::tools::study
