#include "components/problems/vortex.hpp"

#include <numbers>

#include "components/portable_math.hpp"
#include "components/problems/annulus.hpp"

namespace tamp::components
{

namespace
{

/// The solution and its derivatives.
struct VortexMotion {
  Vortex vortex;
  double shear_modulus_over_density;
  double omega;

  /// The angle over sin(omega t), with its derivatives by R.
  struct Turn {
    double value, slope, curvature;
  };
  Turn turn_at(double R) const
  {
    const double depth = vortex.outer_radius - vortex.inner_radius;
    const double q = (R - 0.5 * (vortex.inner_radius + vortex.outer_radius)) / depth;
    const double rest = 1 - 4 * q * q, A = vortex.angle;
    return {A * rest * rest, -16 * A * q * rest / depth, 16 * A * (12 * q * q - 1) / (depth * depth)};
  }

  Vector<3> displacement(const Vector<3>& X, double t) const
  {
    const PolarPlace at = polar_place(X, vortex.centre);
    const double angle = portable::sin(omega * t) * turn_at(at.radius).value;
    // 1 - cos(angle) without its cancellation.
    const double half = portable::sin(0.5 * angle);
    return at.radius * (portable::sin(angle) * at.around - 2 * half * half * at.outwards) + t * vortex.velocity;
  }
  Vector<3> initial_velocity(const Vector<3>& X) const
  {
    const PolarPlace at = polar_place(X, vortex.centre);
    return at.radius * omega * turn_at(at.radius).value * at.around + vortex.velocity;
  }
  Vector<3> body_force(const Vector<3>& X, double t) const
  {
    const PolarPlace at = polar_place(X, vortex.centre);
    const Turn turn = turn_at(at.radius);
    const double R = at.radius, sine = portable::sin(omega * t);
    const double angle = sine * turn.value, slope = sine * turn.slope, curvature = sine * turn.curvature;
    const double rate = omega * portable::cos(omega * t) * turn.value, acceleration = -omega * omega * angle;
    const double outwards = -R * rate * rate + shear_modulus_over_density * R * slope * slope;
    const double around = R * acceleration - shear_modulus_over_density * (3 * slope + R * curvature);
    const double cosine = portable::cos(angle), turned = portable::sin(angle);
    return outwards * (cosine * at.outwards + turned * at.around) +
           around * (cosine * at.around - turned * at.outwards);
  }
};

}  // namespace

BodyFunctions Vortex::functions(const ProblemBody& body) const
{
  check_annulus(*this, body);
  const auto* solid = std::get_if<NeoHookeanLog>(&body.material);
  if (solid == nullptr) throw BadValue("another material", "one of type neo_hookean_log, for which it is made");
  const VortexMotion motion{*this, solid->shear_modulus / body.density, 2 * std::numbers::pi / period};
  return functions_of(*this, motion);
}

}  // namespace tamp::components
