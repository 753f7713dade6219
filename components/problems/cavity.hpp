#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// A manufactured solution that goes through a plastic update: a ring, or a tube or a hollow sphere, whose hole is
/// widened by a pressure on its rim, by the part S, and is then at rest. A point at the distance R from the centre
/// comes to
///
///     r = (R^n + A s)^(1/n),    n = 1 + m,  A = r_i^n ((1 + S)^n - 1),
///     s = tau - sin(2 pi tau) / (2 pi),  tau = min(t / T, 1).
///
/// As r^m dr = R^m dR, circles are stretched by l = r / R and radii by l^-m: all points go along one straight path of
/// logarithmic strains, the further the nearer to the hole, and none is ever unloaded. So the stresses s_R and s_T are
/// functions of e = ln l alone, which are tabulated from the material's own update in small increments. With k hoops, 2
/// for a sphere and 1 otherwise, m = k keeps the volume, more compacts. With the nominal stresses P_R = s_R l^k and
/// P_T = s_T l^(k-1-m), and dl/dR = (l^-m - l) / R, what keeps up the motion is, along the radius,
///
///     b = d^2r/dt^2 - (dP_R/dR + k (P_R - P_T) / R) / density,
///
/// and the pressure -s_R on each rim.
struct Cavity {
  static constexpr std::string_view type = "cavity";
  static constexpr std::string_view meaning =
      "a ring of any material in the plane, in an axisymmetric scene a tube about the axis, or with `spherical` a "
      "hollow sphere, whose hole widens by the part `expansion` within `duration`: "
      "r = (Rⁿ + A(t))^(1/n), n = 1 + `shortening`. Where a circle is stretched by λ its radius is by λ to the power "
      "of "
      "-`shortening`, so that 1 (of a sphere 2) keeps the volume and more compacts. A body force and pressures on both "
      "rims, found "
      "from "
      "the material's own stress, keep that up. Its particles are laid out as those of `\"rotating_disk\"`, or in the "
      "lattice";
  static constexpr std::array<Parameter<Cavity>, 8> parameters();

  Vector<3> centre;     ///< m
  double inner_radius;  ///< r_i [m]
  double outer_radius;  ///< r_o [m]
  double expansion;     ///< S
  double shortening;    ///< m
  double duration;      ///< T [s]
  bool on_rings = true;
  bool spherical = false;

  /// Throws BadValue where the material finds no stress on such a path.
  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<Cavity>, 8> Cavity::parameters()
{
  return {{{"centre", "m", any_number, &Cavity::centre},
           {"inner_radius", "m", above_zero, &Cavity::inner_radius},
           {"outer_radius", "m", above_zero, &Cavity::outer_radius},
           {"expansion", "", above_zero, &Cavity::expansion},
           {"shortening", "", above_zero, &Cavity::shortening},
           {"duration", "s", above_zero, &Cavity::duration},
           {"on_rings", "", any_number, &Cavity::on_rings, "", true},
           {"spherical", "", any_number, &Cavity::spherical, "", true}}};
}

}  // namespace tamp::components
