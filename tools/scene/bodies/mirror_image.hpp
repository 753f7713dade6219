#pragma once

#include <optional>

#include "components/geometry/fill.hpp"
#include "components/geometry/solid.hpp"

namespace tamp::tools
{

/// A site of a lattice in a solid whose image in the plane normal to `axis` at `place` [m] is not in the solid; none if
/// the solid is symmetric about it as far as its particles can tell. Sites on the surface, one in a thousand, may fall
/// to either side by rounding.
template <int D>
std::optional<Vector<D>> first_without_image(const components::Solid<D>& solid,
                                             const components::ParticleLattice<D>& lattice, int axis, double place);

}  // namespace tamp::tools
