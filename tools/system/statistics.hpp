#pragma once

#include <vector>

namespace tamp::tools
{

struct Quartiles {
  double lower, median, upper;
};

/// Linear between the values in order. There must be one at least.
Quartiles quartiles(std::vector<double> values);

/// The median; 0 without values.
double median(std::vector<double> values);

}  // namespace tamp::tools
