#pragma once

#include <string_view>

#include "components/transfers/transfer.hpp"

namespace tamp::components
{

/// Extended PIC of order m (Hammerquist & Nairn, Comput. Methods Appl. Mech. Eng. 318, 2017): PIC, and the terms u_1 to
/// u_{m-1} of the velocities at the start of the step. Particles lose what no node can tell, as in PIC, and of the rest
/// (1 - lambda)^m, lambda being the part that PIC leaves; order 1 is PIC.
struct Xpic : PlainTransfer {
  static constexpr std::string_view word = "xpic";
  static constexpr std::string_view meaning =
      "`\"pic\"` that filters only what the nodes cannot tell apart, the better the higher its order";
  static constexpr std::string_view own_key = "filter_order";

  int order;

  explicit Xpic(const TransferNumbers& numbers) : order(numbers.filter_order) {}

  static constexpr Passes passes = Passes::from_start;
  int n_passes() const { return order - 1; }

  template <int D>
  Vector<D> velocity(const Vector<D>&, const ParticleMotion<D>& motion, const Vector<D>& restored) const
  {
    return motion.velocity + restored;
  }
};

}  // namespace tamp::components
