#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// A manufactured solution for a neo-Hookean block between smooth walls: with s_i = X_i - origin_i,
///
///     u_i = A sin(pi s_i / L) sin(pi c t / L + 2/3 pi i),    c^2 = E / density,
///
/// along the first `n_axes` axes, i = 0, 1, 2 (P. C. Wallstedt and J. E. Guilkey, J. Comput. Phys. 227, 2008, for the
/// logarithmic solid). The block spans L, or a whole number of times that, from `origin` along these axes, and the
/// walls hold it there. F is diagonal, its entries l_i being functions of X_i alone, so that div P along axis i is M_i
/// dl_i/dX_i, and what keeps up the motion is b_i = (pi / L)^2 u_i (M_i / density - c^2). With J the product of the
/// stretches and T the sum of the squares of all three, the law of neo_hookean.hpp has
///
///     M_i = K/2 (J^2 + 1) / l_i^2 + G J^(-2/3) (5/9 T / l_i^2 - 1/3),
///
/// and that of neo_hookean_log.hpp
///
///     M_i = G + (G + lambda (1 - ln J)) / l_i^2.
struct AxisAligned {
  static constexpr std::string_view type = "axis_aligned";
  static constexpr std::string_view meaning =
      "a neo-Hookean block that moves by u_i = amplitude sin(π s_i / length) sin(π c t / length + 2/3 π i) along its "
      "first `n_axes` axes, i from 0, s_i from `origin`, c² = Young's modulus / density. A body force keeps that up. "
      "The block spans `length` from `origin` along those axes, and lies between `\"symmetry\"` faces along all";
  static constexpr std::array<Parameter<AxisAligned>, 4> parameters();

  double amplitude;  ///< A [m]; pi A < L, so that nothing is turned inside out
  double length;     ///< L [m]
  int n_axes;        ///< at most the scene's dimension
  Vector<3> origin = Vector<3>::Zero();

  /// The material is neo-Hookean.
  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<AxisAligned>, 4> AxisAligned::parameters()
{
  return {{{"amplitude", "m", above_zero, &AxisAligned::amplitude},
           {"length", "m", above_zero, &AxisAligned::length},
           {"n_axes", "", {.lower = 1, .upper = 3}, &AxisAligned::n_axes},
           {"origin", "m", any_number, &AxisAligned::origin, "", true}}};
}

}  // namespace tamp::components
