#pragma once

#include <string>
#include <vector>

#include "tools/study/study.hpp"

namespace tamp::tools::study
{

/// `settings` with `others` over them.
Settings merged(Settings settings, const Settings& others);

/// A combination of settings.
struct Point {
  enum class Role {
    chart,
    reference,
    witness,   ///< a run that the reference has to agree with
    variation  ///< a variation of an error budget
  };
  /// Its place in the list, from 1.
  int id = 0;
  Role role = Role::chart;
  std::string method;
  /// Label that distinguishes it from the other points of its method.
  std::string label;
  /// All settings, and those in which the points of its method differ.
  Settings settings, own{};
  /// The method of a reference that serves one method alone.
  std::string reference_of{};

  /// Method and label.
  std::string name() const { return label.empty() ? method : method + ", " + label; }
  /// Name of a run of the reference: "the run with cell size 0.005".
  std::string run_name() const { return label.empty() ? "the run" : "the run with " + label; }
  /// Null where a pointer is not set.
  Json setting(const std::string& pointer) const;
};

/// The names that references and variations go by among the methods.
inline constexpr char reference_name[] = "reference", budget_name[] = "error budget";

/// All points of a study: those of its methods, then of its reference, then of its error budget.
std::vector<Point> points_of(const Study& study);

/// The settings of a budget's base, and of its variations, as points have them.
Settings base_settings(const Study& study, const BudgetBase& base);
Settings varied_settings(const Study& study, const BudgetBase& base, const Settings& variation);

/// Whether a text is a JSON pointer, and not that to a whole document.
bool is_pointer(const std::string& text);
/// As a person would say them: "cell size 0.02, transfer flip".
std::string settings_text(const Settings& settings);
/// The last part of a pointer, with blanks for underscores.
std::string pointer_name(const std::string& pointer);

}  // namespace tamp::tools::study
