#pragma once

#include "components/geometry/solid.hpp"

namespace tamp::test
{

using components::Box;
using components::Solid;

/// The share of the midpoints of n^D equal parts of the bounding box that the solid holds, times the box.
template <int D>
double counted_volume(const Solid<D>& solid, int n)
{
  const Box<D> box = solid.bounding_box();
  const Vector<D> part = (box.upper - box.lower) / n;
  long held = 0;
  for (int k = 0; k < (D == 3 ? n : 1); ++k) {
    for (int j = 0; j < n; ++j) {
      for (int i = 0; i < n; ++i) {
        Vector<D> x = box.lower;
        x[0] += (i + 0.5) * part[0];
        x[1] += (j + 0.5) * part[1];
        if constexpr (D == 3) x[2] += (k + 0.5) * part[2];
        held += solid.contains(x);
      }
    }
  }
  return static_cast<double>(held) * part.prod();
}

}  // namespace tamp::test
