#pragma once

#include <filesystem>
#include <vector>

#include "tools/study/measurement.hpp"
#include "tools/study/point_results.hpp"

namespace tamp::tools::study
{

/// Runs all points that `cache` has no result of, one after another, each in a process of its own. What the charts show
/// is timed several times, in rounds through all points, so that what else the machine does hits all alike. Each result
/// is kept in the cache as soon as it is there: an interrupted study goes on where it was.
///
/// Throws InputError where a point lacks a column that a quantity asks for, Interrupted when a signal asks to stop.
std::vector<PointResult> run_points(const Study& study, const std::vector<Point>& points,
                                    const std::vector<Measurement>& measurements, const std::filesystem::path& cache,
                                    bool quiet);

}  // namespace tamp::tools::study
