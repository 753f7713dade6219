#pragma once

#include <type_traits>
#include <variant>

#include "components/boundary/no_slip_wall.hpp"
#include "components/boundary/passages.hpp"
#include "components/boundary/rough_wall.hpp"
#include "components/boundary/symmetry.hpp"

namespace tamp::components
{

/// All that a face of the grid may be, see face.hpp; one more is added here.
using Face = std::variant<SymmetryFace, OpenFace, NoSlipWall, PeriodicFace, RoughWall>;

inline FaceTraits traits_of(const Face& face)
{
  return std::visit([](const auto& kind) { return kind.traits(); }, face);
}

/// Calls `visit(wall)` with the kind of the face where that is a wall which is no mirror.
template <class Visit>
void with_wall(const Face& face, const Visit& visit)
{
  std::visit(
      [&]<class Kind>(const Kind& kind) {
        if constexpr (Kind{}.traits().is_wall() && !Kind{}.traits().is_mirror) visit(kind);
      },
      face);
}

}  // namespace tamp::components
