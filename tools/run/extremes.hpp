#pragma once

#include <cmath>
#include <limits>

namespace tamp::tools
{

/// The greatest and the least of a column of the history so far, with their times [s]; NaN as long as there was no
/// number.
struct Extremes {
  double greatest = std::numeric_limits<double>::quiet_NaN(), greatest_time = 0;
  double least = std::numeric_limits<double>::quiet_NaN(), least_time = 0;

  void take(double value, double time)
  {
    if (std::isnan(value)) return;
    if (!(value <= greatest)) {
      greatest = value;
      greatest_time = time;
    }
    if (!(value >= least)) {
      least = value;
      least_time = time;
    }
  }
};

}  // namespace tamp::tools
