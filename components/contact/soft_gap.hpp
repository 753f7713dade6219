#pragma once

#include <algorithm>

#include "components/portable_math.hpp"

namespace tamp::components
{

/// How much a particle near a surface counts at its nodes, for S = 1, and its gap [m].
struct SoftGap {
  double weight, gap;
};

/// Weight and gap of a particle at `distance` from a surface; the particle is `width` wide along the normal, and was
/// `size` wide at the start [m].
inline SoftGap soft_gap(double distance, double width, double size)
{
  // Rows behind the first make the soft minimum larger than its gap: by 1 / (e^3 - 1) of a width if all weigh the same,
  // less at the surface, where the second has a third of the first's S. Hertz's force (tamp verify hertz_ball) is right
  // to 4 % on 4 cells a contact radius with two thirds of that, and 11 % too small without.
  constexpr double of_rows_behind = 0.035;
  // The distance, in sizes, that a node can see; deep within the body nothing may overflow.
  constexpr double farthest = 8;
  const double weight = portable::exp(-3 * std::clamp(distance / size, -farthest, farthest));
  return {weight, distance - (0.5 + of_rows_behind) * width};
}

}  // namespace tamp::components
