#pragma once

#include <optional>
#include <vector>

#include "tools/study/point_results.hpp"

namespace tamp::tools::study
{

/// A point's answer: a number, or for quantities that are columns the column, and its times where it has any.
struct Answer {
  double value = 0;
  std::vector<double> times, column;
};

/// Answer of a point that is done. Throws InputError if a column, field or number of it is missing.
Answer answer_of(const Study& study, const Quantity& quantity, const PointResult& result);

/// How far two answers are apart: `b` less `a` for numbers, and what `Take` says of columns, `a` the reference.
double distance(const Quantity& quantity, const Answer& a, const Answer& b);

/// Whether all that the study asks for is still in the result's folder.
bool has_all(const Study& study, const PointResult& result);
/// Throws InputError if not.
void expect_all(const Study& study, const PointResult& result);
/// Whether a quantity needs `fields.h5`.
bool asks_for_fields(const Study& study);

/// In the column's name, such as "m" of `punch.depth[m]`; empty for none.
std::string unit_of(const Quantity& quantity);

}  // namespace tamp::tools::study
