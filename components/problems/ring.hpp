#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// A manufactured solution: a ring, or a tube or a hollow sphere, without a Poisson's ratio that widens and narrows,
/// its rims free (P. C. Wallstedt and J. E. Guilkey, J. Comput. Phys. 227, 2008). A point at the distance R from the
/// centre moves away from it by
///
///     u = A sin(omega t) (c1 R + c2 R^2 + c3 R^3),    omega = pi / (r_i + r_o) sqrt(E / density),
///     c1 = -6 r_i / (r_o d),  c2 = 3 (r_i + r_o) / (r_o^2 d),  c3 = -2 / (r_o^2 d),    d = r_o - 3 r_i,
///
/// A being the amplitude at the outer rim. The principal stretches are l_R = 1 + u', 1 at both rims, and
/// l_T = 1 + u / R; the law of neo_hookean_log.hpp has P_i = G (l_i - 1 / l_i) for lambda = 0, so that the rims bear no
/// traction. With dP_R/dR = G (1 + 1 / l_R^2) u'', what keeps up the motion is, along the radius,
///
///     b = d^2u/dt^2 - (dP_R/dR + k (P_R - P_T) / R) / density,
///
/// k being the number of hoops, 2 for a sphere and 1 otherwise.
///
/// The particles lie on rings, or in the lattice, which makes the rims steps.
struct Ring {
  static constexpr std::string_view type = "ring";
  static constexpr std::string_view meaning =
      "a ring in the plane, in an axisymmetric scene a tube about the axis, or with `spherical` a hollow sphere, of "
      "type neo_hookean_log and Poisson's ratio 0, that widens and narrows between free rims "
      "by "
      "u = amplitude sin(π c t / (r_i + r_o)) (c₁ R + c₂ R² + c₃ R³), c² = Young's modulus / density, c₁ to c₃ being "
      "those that give it `amplitude` at the outer rim and no radial strain at either. A body force keeps that up. Its "
      "particles are laid out as those of `\"rotating_disk\"`, or in the lattice";
  static constexpr std::array<Parameter<Ring>, 6> parameters();

  Vector<3> centre;     ///< m
  double inner_radius;  ///< r_i [m]
  double outer_radius;  ///< r_o [m], not 3 r_i
  double amplitude;     ///< A [m]; nothing is turned inside out
  bool on_rings = true;
  bool spherical = false;

  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<Ring>, 6> Ring::parameters()
{
  return {{{"centre", "m", any_number, &Ring::centre},
           {"inner_radius", "m", above_zero, &Ring::inner_radius},
           {"outer_radius", "m", above_zero, &Ring::outer_radius},
           {"amplitude", "m", above_zero, &Ring::amplitude},
           {"on_rings", "", any_number, &Ring::on_rings, "", true},
           {"spherical", "", any_number, &Ring::spherical, "", true}}};
}

}  // namespace tamp::components
