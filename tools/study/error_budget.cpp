#include "tools/study/error_budget.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp::tools::study
{

namespace
{

class BudgetMaker
{
 public:
  BudgetMaker(const Study& study, const std::vector<MeasuredPoint>& points, const Quantity& quantity,
              const Reference& reference)
      : study_(study), points_(points), quantity_(quantity), reference_(reference)
  {
  }

  ErrorBudget make(const BudgetBase& base) const
  {
    ErrorBudget budget{quantity_.name, base.name, std::nullopt, {}};
    const auto answer = answer_with(base_settings(study_, base));
    if (answer && !quantity_.is_column()) budget.value = answer->value;
    for (const BudgetPart& part : study_.budget->parts) {
      budget.parts.push_back(!answer             ? BudgetAmount{part.name, std::nullopt, "the base is not done"}
                             : part.to_reference ? from_reference(part, *answer)
                                                 : from_variations(base, part, *answer));
    }
    return budget;
  }

 private:
  std::optional<Answer> answer_with(const Settings& settings) const
  {
    for (const MeasuredPoint& one : points_) {
      if (one.point.settings == settings && one.done()) return answer_of(study_, quantity_, one.result);
    }
    return std::nullopt;
  }

  BudgetAmount from_reference(const BudgetPart& part, const Answer& base) const
  {
    const auto error = reference_.error(quantity_, base);
    if (!error) return {part.name, std::nullopt, reference_.note};
    const std::string text = fmt::format("{:.2g} % from the reference", *error * 100);
    if (!reference_.bound) return {part.name, std::nullopt, text + ", which is no bound: " + reference_.note};
    return {part.name, *error + reference_.uncertainty.value_or(0),
            fmt::format("{}, which is known to {:.2g} %", text, reference_.uncertainty.value_or(0) * 100)};
  }

  BudgetAmount from_variations(const BudgetBase& base, const BudgetPart& part, const Answer& answer) const
  {
    BudgetAmount found{part.name, 0.0, ""};
    for (const Settings& variation : part.variations) {
      const auto other = answer_with(varied_settings(study_, base, variation));
      const std::string text = settings_text(variation);
      if (!found.note.empty()) found.note += ", ";
      const double change = other ? distance(quantity_, answer, *other) / scale(answer) : NAN;
      found.note += text + (std::isfinite(change) ? fmt::format(": {:+.2g} %", change * 100) : ": not known");
      // The missing part might be the largest.
      if (!std::isfinite(change)) found.amount.reset();
      if (found.amount) found.amount = std::max(*found.amount, std::abs(change));
    }
    return found;
  }

  /// Scale of relative changes; 0 for an answer of 0, whose changes are no parts of it.
  double scale(const Answer& base) const
  {
    return quantity_.is_column() ? 1 : quantity_.scale.value_or(std::abs(base.value));
  }

  const Study& study_;
  const std::vector<MeasuredPoint>& points_;
  const Quantity& quantity_;
  const Reference& reference_;
};

}  // namespace

ErrorBudget error_budget(const Study& study, const BudgetBase& base, const Quantity& quantity,
                         const Reference& reference, const std::vector<MeasuredPoint>& points)
{
  return BudgetMaker(study, points, quantity, reference).make(base);
}

}  // namespace tamp::tools::study
