#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace tamp::tools::compare
{

struct PlotPoint {
  double x, y;
};

/// A power of 1000 and its sign in the SI: `value / factor` is a number for people.
struct SiPrefix {
  double factor;
  std::string_view symbol;
};

/// The prefix with which `magnitude` lies in [1, 1000); the last one beyond pico and tera, none for 0.
SiPrefix si_prefix(double magnitude);

/// Three digits with a prefix, such as "312 µs".
std::string si_text(double value, std::string_view unit);

/// Round numbers, 1, 2 or 5 times a power of ten apart and about `n_wanted` of them, the first at or below `low` and
/// the last at or above `high`.
std::vector<double> linear_ticks(double low, double high, int n_wanted);

/// 1, 2 and 5 times the powers of ten, only these over more than two decades; both bounds are above 0 and within.
std::vector<double> log_ticks(double low, double high);

/// About `n_wanted` points at most, in order: of each stretch its lowest and its highest point, so that no peak is
/// lost; the first and the last point are kept.
std::vector<PlotPoint> thinned(std::span<const PlotPoint> points, std::size_t n_wanted);

}  // namespace tamp::tools::compare
