#pragma once

#include <bit>
#include <cmath>
#include <cstdint>

namespace tamp::test
{

/// Also of zeros and infinities; any of what is no number is as good as another.
inline bool same_bits(double a, double b)
{
  return std::bit_cast<std::uint64_t>(a) == std::bit_cast<std::uint64_t>(b) || (std::isnan(a) && std::isnan(b));
}

}  // namespace tamp::test
