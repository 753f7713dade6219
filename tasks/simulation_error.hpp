#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "runtime/step_error.hpp"

namespace tamp::tasks
{

/// A simulation that has become invalid: which particle, where, and why. Whoever runs it adds step and time.
struct SimulationError : runtime::StepError {
  SimulationError(const std::string& reason, std::string material_, std::int64_t particle_,
                  std::vector<double> position_);

  std::string material;
  /// -1 where no single particle is to blame.
  std::int64_t particle;
  /// m
  std::vector<double> position;
};

}  // namespace tamp::tasks
