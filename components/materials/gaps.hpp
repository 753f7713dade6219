#pragma once

#include "components/lanes.hpp"

namespace tamp::components
{

/// Where grains may part: gaps between them, as a volumetric strain. While there are gaps, the soil bears and resists
/// nothing; it joins when they have closed, and takes what it is compacted by beyond that in the same step as plastic
/// strain: the step may have been longer than soil with stiffness can stand.
struct Gaps {
  Mask<Lanes> before{false}, still{false};
  Lanes opening = 0.0;     ///< at the end of the step, of those that were apart before
  Lanes compaction = 0.0;  ///< beyond the closing of those that join

  Gaps() = default;
  Gaps(const Lanes& old_opening, const Lanes& expansion)
      : before(old_opening > 0.0),
        still(before && old_opening + expansion > 0.0),
        opening(select(still, old_opening + expansion, Lanes(0.0))),
        compaction(select(before && !still, -(old_opening + expansion), Lanes(0.0)))
  {
  }
};

}  // namespace tamp::components
