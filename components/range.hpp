#pragma once

#include <limits>
#include <string>

namespace tamp::components
{

/// The range of numbers that a parameter may have.
struct Range {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  bool holds_lower = true;
  bool holds_upper = true;

  bool contains(double x) const;
  /// The range in words, such as "above 0" or "from 0 to 1"; empty if every number will do.
  std::string words() const;
};

inline constexpr Range any_number{};
inline constexpr Range above_zero{.lower = 0, .holds_lower = false};
inline constexpr Range zero_or_above{.lower = 0};

}  // namespace tamp::components
