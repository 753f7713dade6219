#pragma once

#include <optional>
#include <string>
#include <vector>

#include "tools/study/reference.hpp"

namespace tamp::tools::study
{

struct BudgetAmount {
  std::string name;
  /// Relative to the base's answer; empty where there is no bound, or a run is missing.
  std::optional<double> amount;
  std::string note;
};

/// What the error of one quantity consists of, at one base.
struct ErrorBudget {
  std::string quantity, base;
  std::optional<double> value;
  std::vector<BudgetAmount> parts;
};

/// Of the base's answer and those of the points that differ from it in one part's settings; of what is compared with
/// the reference, its uncertainty counts too.
ErrorBudget error_budget(const Study& study, const BudgetBase& base, const Quantity& quantity,
                         const Reference& reference, const std::vector<MeasuredPoint>& points);

}  // namespace tamp::tools::study
