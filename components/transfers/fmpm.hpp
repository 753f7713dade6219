#pragma once

#include <string_view>

#include "components/transfers/pic.hpp"

namespace tamp::components
{

/// PIC with nodes that move by an approximate inverse of the full mass matrix in place of the lumped one, of order k
/// (Nairn & Hammerquist, Comput. Methods Appl. Mech. Eng. 377, 2021): their velocities are u_0 + ... + u_{k-1} from
/// those that contact and walls have left, for the particles' velocities, places and deformation alike. Order 1 is PIC.
struct Fmpm : Pic {
  static constexpr std::string_view word = "fmpm";
  static constexpr std::string_view meaning =
      "`\"pic\"` by an approximate inverse of the full mass matrix, which filters as `\"xpic\"` does";
  static constexpr std::string_view own_key = "filter_order";

  int order;

  explicit Fmpm(const TransferNumbers& numbers) : order(numbers.filter_order) {}

  static constexpr Passes passes = Passes::from_end;
  int n_passes() const { return order - 1; }
  /// The terms are all the same for what particles see nothing of.
  double amplification() const { return order; }
};

}  // namespace tamp::components
