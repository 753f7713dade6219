#pragma once

#include <vector>

#include "components/geometry/fill.hpp"
#include "components/geometry/polar_layout.hpp"

namespace tamp::components
{

/// The particles of the part of `solid` within `cells`, one for each site of the lattice: with the volume of what the
/// solid holds of the site's share of its cell, in the middle of that, so that steps of the lattice neither add to the
/// body nor roughen its outline. Less than half a share goes to the neighbours with the most. Inside, and in a box
/// along the lattice, they are those of fill(), bit for bit. Where the solid's volume is exact and `cells` hold all of
/// it, that of the particles is the same; else their shares are counted at points, 32 along an axis in the plane and
/// 10 in space. Throws as fill() does.
template <int D>
std::vector<Site<D>> fill_cut(const Solid<D>& solid, const ParticleLattice<D>& lattice, const CellRange<D>& cells);

}  // namespace tamp::components
