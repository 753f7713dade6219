#pragma once

#include <cstdint>
#include <string>

namespace tamp::runtime
{

/// What a checkpoint is of.
struct CheckpointHeader {
  std::int64_t step = 0;
  /// [s]
  double time = 0;
  /// Tells one scene from another; given by the host, who decides what it means when it differs.
  std::string fingerprint;
};

}  // namespace tamp::runtime
