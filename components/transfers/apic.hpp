#pragma once

#include <string_view>

#include "components/transfers/pic.hpp"

namespace tamp::components
{

/// Affine particle in cell: PIC whose particles bring m S (v_p + C_p (x_i - x_p)), C_p = B_p D_p^-1 (Jiang et al., ACM
/// Trans. Graph. 34, 2015). B_p are the first moments of the velocities of the nodes, which particles keep, and D_p the
/// second moments of the weights by which they are then brought: so angular momentum, with that of B_p, is exact for
/// any weights. Weights have to have second moments wherever the particle is.
struct Apic : Pic {
  static constexpr std::string_view word = "apic";
  static constexpr std::string_view meaning = "`\"pic\"` with the gradients by which angular momentum is exact";

  static constexpr CarriedGradient carried_gradient = CarriedGradient::moment;
};

}  // namespace tamp::components
