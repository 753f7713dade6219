#pragma once

#include "components/geometry/solid.hpp"

namespace tamp::components
{

/// Volumes [m^3] of a solid, and of its section z = 0 whose half x > 0 is turned about the line x = z = 0.
struct TurnedVolumes {
  double solid;
  double turned;
  double apart;  ///< volume that is in one of the two alone
};

/// Counts points of a fixed sequence: mostly within 0.5 %, and exactly alike for a solid that is round about the line.
TurnedVolumes volumes_of_turning(const Solid<3>& solid);

}  // namespace tamp::components
