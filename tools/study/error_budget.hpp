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

/// Parts of the error of one quantity, at one base.
struct ErrorBudget {
  std::string quantity, base;
  std::optional<double> value;
  std::vector<BudgetAmount> parts;
};

/// Compares the base's answer with those of the points that differ from it in one part's settings; a comparison with
/// the reference includes its uncertainty.
ErrorBudget error_budget(const Study& study, const BudgetBase& base, const Quantity& quantity,
                         const Reference& reference, const std::vector<MeasuredPoint>& points);

}  // namespace tamp::tools::study
