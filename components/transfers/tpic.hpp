#pragma once

#include <string_view>

#include "components/transfers/pic.hpp"

namespace tamp::components
{

/// Taylor particle in cell: PIC whose particles bring the gradient of velocity too, m S (v_p + grad v_p (x_i - x_p))
/// (Nakamura, Matsumura & Mizutani, Comput. Methods Appl. Mech. Eng. 403, 2023).
struct Tpic : Pic {
  static constexpr std::string_view word = "tpic";
  static constexpr std::string_view meaning = "`\"pic\"` with gradients";

  static constexpr CarriedGradient carried_gradient = CarriedGradient::gradient;
};

}  // namespace tamp::components
