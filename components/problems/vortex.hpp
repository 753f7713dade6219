#pragma once

#include <array>
#include <string_view>

#include "components/parameter.hpp"
#include "components/problems/body_functions.hpp"

namespace tamp::components
{

/// The generalised vortex, a manufactured solution of large rotation and shear in the plane (K. Kamojjala, R. Brannon,
/// A. Sadeghirad and J. Guilkey, Engineering with Computers 31, 2015): between the radii r_i and r_o a ring turns about
/// its centre by an angle that goes to and fro, and that is 0 at both rims,
///
///     alpha(R, t) = A sin(2 pi t / period) (1 - 4 q^2)^2,    q = (R - (r_i + r_o) / 2) / (r_o - r_i).
///
/// R stays what it is and so does the volume. With g = R dalpha/dR the law of neo_hookean_log.hpp has the stresses
/// G g across and G g^2 around, and no other but zz, at rims none. What keeps up the motion is, in the directions
/// outwards from and around the centre where the point now is,
///
///     b_r = -R alpha_t^2 + G / density R alpha_R^2,
///     b_t = R alpha_tt - G / density (3 alpha_R + R alpha_RR).
///
/// All that may move along at a constant velocity besides. The particles lie on rings, or in the lattice, which makes
/// the rims steps.
struct Vortex {
  static constexpr std::string_view type = "vortex";
  static constexpr std::string_view meaning =
      "a ring in the plane, of type neo_hookean_log, each circle of which turns by angle sin(2 π t / period) (1 − 4 "
      "q²)², "
      "q from −1/2 at the inner rim to 1/2 at the outer one, while all moves along at `velocity`. A body force keeps "
      "that up; the rims are free. Its particles are laid out as those of `\"rotating_disk\"`, or in the lattice";
  static constexpr std::array<Parameter<Vortex>, 7> parameters();

  Vector<3> centre;     ///< m
  double inner_radius;  ///< r_i [m]
  double outer_radius;  ///< r_o [m]
  double angle;         ///< A [rad]
  double period;        ///< s
  Vector<3> velocity = Vector<3>::Zero();
  bool on_rings = true;

  BodyFunctions functions(const ProblemBody& body) const;
};

constexpr std::array<Parameter<Vortex>, 7> Vortex::parameters()
{
  return {{{"centre", "m", any_number, &Vortex::centre},
           {"inner_radius", "m", above_zero, &Vortex::inner_radius},
           {"outer_radius", "m", above_zero, &Vortex::outer_radius},
           {"angle", "rad", any_number, &Vortex::angle},
           {"period", "s", above_zero, &Vortex::period},
           {"velocity", "m/s", any_number, &Vortex::velocity, "", true},
           {"on_rings", "", any_number, &Vortex::on_rings, "", true}}};
}

}  // namespace tamp::components
