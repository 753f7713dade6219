#pragma once

#include <fmt/format.h>

#include <cmath>
#include <string>

namespace tamp::tools
{

/// In two digits, without a power of ten: 3100, 47, 0.25.
inline std::string two_digits(double x)
{
  if (!(x >= 100)) return fmt::format("{:.2g}", x);
  const double digit = std::pow(10, std::floor(std::log10(x)) - 1);
  return fmt::format("{:.0f}", digit * std::round(x / digit));
}

}  // namespace tamp::tools
