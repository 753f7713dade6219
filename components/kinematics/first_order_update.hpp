#pragma once

#include <string_view>

#include "components/kinematics/exact_update.hpp"

namespace tamp::components
{

/// As published codes have it: F as in the exact update, but the strain is the symmetric part of g, taken to be in the
/// axes of the end of the step. A step that turns a particle by an angle strains it by half of the angle's square.
struct FirstOrderUpdate : ExactUpdate {
  static constexpr std::string_view word = "first_order";
  static constexpr std::string_view meaning =
      "by 1 + g, with the symmetric part of g for strain, as published codes have it";

  template <int D, class Number>
  static SymmetricTensor<D, Number> strain(const Matrix<D, Number>&, const Matrix<D, Number>& g,
                                           const Matrix<D, Number>&, const Matrix<D, Number>&)
  {
    return symmetric_part<D>(g);
  }
  template <class Number>
  static Number stretch_strain(const Number& g)
  {
    return g;
  }
};

}  // namespace tamp::components
