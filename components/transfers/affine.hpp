#pragma once

#include <string_view>

#include "components/transfers/flip.hpp"

namespace tamp::components
{

/// FLIP whose particles bring the gradient of velocity too, m S (v_p + grad v_p (x_i - x_p)) (Wallstedt & Guilkey, CMES
/// 19, 2007).
struct Affine : Flip {
  static constexpr std::string_view word = "affine";
  static constexpr std::string_view meaning =
      "`\"flip\"` whose particles bring gradients too, so that bodies only a few cells thick turn as fast as they spin";

  static constexpr Surroundings surroundings = Surroundings::gradient;
};

}  // namespace tamp::components
