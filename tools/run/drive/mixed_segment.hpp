#pragma once

#include "tools/run/drive/course.hpp"
#include "tools/run/drive/mixed_path.hpp"

namespace tamp::tools
{

/// The way from one row of a mixed path to the next.
struct MixedSegment {
  const std::vector<StressControl>& controls;
  const MixedRow& from;
  const MixedRow& to;
  std::size_t row;  ///< row of `to`, counted from 1
};

/// Takes the point, which is where the segment begins, along it; increments are chosen and errors thrown as drive()
/// says for mixed paths.
void follow(const Course& course, const MixedSegment& segment, MaterialPoint& point);

}  // namespace tamp::tools
