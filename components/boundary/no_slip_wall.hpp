#pragma once

#include <string_view>

#include "components/boundary/face.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

struct NoSlipWall {
  static constexpr std::string_view word = "no_slip", meaning = "material that touches the wall does not move";
  static constexpr FaceTraits traits() { return {}; }
  friend bool operator==(const NoSlipWall&, const NoSlipWall&) = default;

  template <int D>
  Vector<D> velocity(const Vector<D>&, const WallNode&) const
  {
    return Vector<D>::Zero();
  }
  template <int D>
  Vector<D> carried_velocity(const Vector<D>&, const WallNode&) const
  {
    return Vector<D>::Zero();
  }
};

}  // namespace tamp::components
