#pragma once

#include <optional>
#include <span>

namespace tamp::tools::bench
{

/// A measurement with tasks of one length: the time that they took, and the part of it that was work.
struct TaskSample {
  /// Time of all threads over the number of tasks [ns].
  double granularity = 0;
  /// Time of the kernel alone, at the speed that the processor had at the time [ns].
  double kernel = 0;

  double efficiency() const { return kernel / granularity; }
};

/// METG(50 %), the minimum effective task granularity [ns]: where the efficiency first rises through one half, between
/// two samples interpolated in the logarithm of the granularity. None if it does not. Samples by rising kernel.
std::optional<double> metg50(std::span<const TaskSample> samples);

}  // namespace tamp::tools::bench
