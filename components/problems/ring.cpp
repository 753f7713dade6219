#include "components/problems/ring.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "components/portable_math.hpp"
#include "components/problems/annulus.hpp"

namespace tamp::components
{

namespace
{

/// A polynomial of the radius with its derivatives, over the amplitude.
struct RadialProfile {
  double c1, c2, c3;

  double value(double R) const { return R * (c1 + R * (c2 + R * c3)); }
  double slope(double R) const { return c1 + R * (2 * c2 + R * 3 * c3); }
  double curvature(double R) const { return 2 * c2 + R * 6 * c3; }
};

RadialProfile profile_of(const Ring& ring)
{
  const double inner = ring.inner_radius, outer = ring.outer_radius;
  const double square = outer * outer * (outer - 3 * inner);
  return {-6 * inner * outer / square, 3 * (inner + outer) / square, -2 / square};
}

/// The greatest strain, radial or around, over the amplitude and either way [1/m]. Both strains are parabolas of R, so
/// that they are greatest at a rim or at their vertex.
double greatest_strain(const Ring& ring)
{
  const RadialProfile profile = profile_of(ring);
  const double middle = 0.5 * (ring.inner_radius + ring.outer_radius);
  const double vertex = std::clamp(-0.5 * profile.c2 / profile.c3, ring.inner_radius, ring.outer_radius);
  double greatest = std::abs(profile.slope(middle));
  for (const double R : {ring.inner_radius, vertex, ring.outer_radius}) {
    greatest = std::max(greatest, std::abs(profile.value(R) / R));
  }
  return greatest;
}

/// The solution and its derivatives.
struct RingMotion {
  Ring ring;
  Shells shells;
  RadialProfile profile;
  double density;
  double shear_modulus;
  double omega;

  double amplitude(double t) const { return ring.amplitude * portable::sin(omega * t); }

  Vector<3> displacement(const Vector<3>& X, double t) const
  {
    const PolarPlace at = polar_place(X, ring.centre, shells);
    return amplitude(t) * profile.value(at.radius) * at.outwards;
  }
  Vector<3> initial_velocity(const Vector<3>& X) const
  {
    const PolarPlace at = polar_place(X, ring.centre, shells);
    return omega * ring.amplitude * profile.value(at.radius) * at.outwards;
  }
  Vector<3> body_force(const Vector<3>& X, double t) const
  {
    const PolarPlace at = polar_place(X, ring.centre, shells);
    const double R = at.radius, A = amplitude(t), G = shear_modulus;
    const double along = 1 + A * profile.slope(R), across = 1 + A * profile.value(R) / R;
    const auto nominal_stress = [&](double stretch) { return G * (stretch - 1 / stretch); };
    const double divergence = G * (1 + 1 / (along * along)) * A * profile.curvature(R) +
                              n_hoops(shells) * (nominal_stress(along) - nominal_stress(across)) / R;
    return (-omega * omega * A * profile.value(R) - divergence / density) * at.outwards;
  }
};

/// The ring's shear modulus; throws BadValue where its rims would bear tractions.
double modulus_without_poisson_ratio(const MaterialModel& material)
{
  constexpr double rounding = 1e-6;
  const auto* solid = std::get_if<NeoHookeanLog>(&material);
  if (solid == nullptr) throw BadValue("another material", "one of type neo_hookean_log, for which it is made");
  if (std::abs(solid->lambda()) > rounding * solid->shear_modulus) {
    throw BadValue(
        fmt::format("a material of bulk modulus {}", solid->bulk_modulus),
        fmt::format("2/3 of its shear modulus, {}, with which its rims are free", 2.0 / 3.0 * solid->shear_modulus));
  }
  return solid->shear_modulus;
}

}  // namespace

BodyFunctions Ring::functions(const ProblemBody& body) const
{
  const Shells shells = shells_of(*this, body);
  const double shear_modulus = modulus_without_poisson_ratio(body.material);
  if (outer_radius == 3 * inner_radius) {
    throw BadParameter("outer_radius", fmt::format("{}", outer_radius),
                       "other than three times the inner one, at which this motion has none at the outer rim");
  }
  if (!(amplitude * greatest_strain(*this) < 1)) {
    throw BadParameter("amplitude", fmt::format("{}", amplitude),
                       fmt::format("less than {:.6g}, as more turns the ring inside out", 1 / greatest_strain(*this)));
  }
  // Without a Poisson's ratio E is 2 G.
  const double omega = std::numbers::pi / (inner_radius + outer_radius) * std::sqrt(2 * shear_modulus / body.density);
  const RingMotion motion{*this, shells, profile_of(*this), body.density, shear_modulus, omega};
  return functions_of(*this, motion, shells);
}

}  // namespace tamp::components
