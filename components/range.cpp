#include "components/range.hpp"

#include <fmt/core.h>

#include <cmath>

namespace tamp::components
{

bool Range::contains(double x) const
{
  return (holds_lower ? x >= lower : x > lower) && (holds_upper ? x <= upper : x < upper);
}

std::string Range::words() const
{
  const bool bounded_below = std::isfinite(lower), bounded_above = std::isfinite(upper);
  if (bounded_below && bounded_above) {
    if (holds_lower && holds_upper) return fmt::format("from {} to {}", lower, upper);
    if (holds_lower) return fmt::format("from {} to below {}", lower, upper);
    return fmt::format("above {} and {} {}", lower, holds_upper ? "up to" : "below", upper);
  }
  if (bounded_below) return holds_lower ? fmt::format("of {} or above", lower) : fmt::format("above {}", lower);
  if (bounded_above) return holds_upper ? fmt::format("up to {}", upper) : fmt::format("below {}", upper);
  return "";
}

}  // namespace tamp::components
