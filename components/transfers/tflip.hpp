#pragma once

#include <string_view>

#include "components/transfers/flip.hpp"

namespace tamp::components
{

/// Taylor FLIP: FLIP whose particles bring the gradient of velocity too, m S (v_p + grad v_p (x_i - x_p)) (Wallstedt &
/// Guilkey, CMES 19, 2007).
struct Tflip : Flip {
  static constexpr std::string_view word = "tflip";
  static constexpr std::string_view old_word = "affine";
  static constexpr std::string_view meaning =
      "`\"flip\"` whose particles bring gradients too, so that bodies only a few cells thick turn as fast as they spin";

  static constexpr CarriedGradient carried_gradient = CarriedGradient::gradient;
};

}  // namespace tamp::components
