#pragma once

#include <cstdint>

namespace tamp::runtime
{

/// Which steps a trace holds: none, the first of this run, those of a range, or the slowest.
struct TraceChoice {
  enum class Kind { none, first, range, slowest };

  Kind kind = Kind::none;
  /// First and last step of a range, both included; step 1 is the first of a simulation. For `Kind::first`, `last` is
  /// the number of steps.
  std::int64_t first = 0;
  std::int64_t last = 0;

  static TraceChoice none() { return {}; }
  static TraceChoice first_steps(std::int64_t n) { return {n > 0 ? Kind::first : Kind::none, 1, n}; }
  static TraceChoice range(std::int64_t first, std::int64_t last) { return {Kind::range, first, last}; }
  static TraceChoice slowest() { return {Kind::slowest, 0, 0}; }
};

}  // namespace tamp::runtime
