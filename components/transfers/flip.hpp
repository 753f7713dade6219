#pragma once

#include <string_view>

#include "components/transfers/transfer.hpp"

namespace tamp::components
{

/// Fluid implicit particle: particles keep their velocity and take the nodes' changes of it (Brackbill & Ruppel 1986;
/// PAR-10021867-092020-6, eq. 45).
struct Flip : PlainTransfer {
  static constexpr std::string_view word = "flip";
  static constexpr std::string_view meaning = "particles bring theirs to the grid and take the nodes' changes of them";

  static constexpr bool filters = false;

  template <int D>
  Vector<D> velocity(const Vector<D>& before, const ParticleMotion<D>& motion, const Vector<D>&) const
  {
    return before + motion.velocity_change;
  }
};

}  // namespace tamp::components
