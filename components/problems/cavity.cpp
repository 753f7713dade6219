#include "components/problems/cavity.hpp"

#include <algorithm>
#include <memory>
#include <numbers>

#include "components/curves/monotone_cubic.hpp"
#include "components/portable_math.hpp"
#include "components/problems/annulus.hpp"
#include "components/problems/stress_path.hpp"

namespace tamp::components
{

namespace
{

double power(double base, double exponent)
{
  return portable::exp(exponent * portable::log(base));
}

/// s_R and s_T [Pa] against e.
struct StressAroundHole {
  MonotoneCubic radial;
  MonotoneCubic hoop;
};

/// The solution and its derivatives.
struct CavityMotion {
  Cavity cavity;
  Shells shells;
  double density;
  std::shared_ptr<const StressAroundHole> stress;
  /// n, and A.
  double exponent = 1 + cavity.shortening;
  double final_growth = power(cavity.inner_radius, exponent) * (power(1 + cavity.expansion, exponent) - 1);

  static constexpr double pi = std::numbers::pi;

  double tau(double t) const { return std::min(t / cavity.duration, 1.0); }
  /// A s and its derivatives by time.
  double growth(double t) const { return final_growth * (tau(t) - portable::sin(2 * pi * tau(t)) / (2 * pi)); }
  double growth_rate(double t) const { return final_growth * (1 - portable::cos(2 * pi * tau(t))) / cavity.duration; }
  double growth_acceleration(double t) const
  {
    return final_growth * 2 * pi * portable::sin(2 * pi * tau(t)) / (cavity.duration * cavity.duration);
  }

  double radius(double R, double t) const { return power(power(R, exponent) + growth(t), 1 / exponent); }
  double acceleration(double R, double t) const
  {
    const double r = radius(R, t), by_growth = 1 / (exponent * power(r, exponent - 1));
    const double rate = by_growth * growth_rate(t);
    return by_growth * growth_acceleration(t) - (exponent - 1) * rate * rate / r;
  }

  Vector<3> displacement(const Vector<3>& X, double t) const
  {
    const PolarPlace at = polar_place(X, cavity.centre, shells);
    return (radius(at.radius, t) - at.radius) * at.outwards;
  }
  Vector<3> body_force(const Vector<3>& X, double t) const
  {
    const PolarPlace at = polar_place(X, cavity.centre, shells);
    const double R = at.radius, hoop = radius(R, t) / R, along = power(hoop, -cavity.shortening);
    const CubicValue radial = stress->radial.at(portable::log(hoop));
    // dP_R/dR = l^(k-1) (ds_R/de + k s_R) dl/dR, and its share of other hoops.
    const int k = n_hoops(shells);
    const double divergence = (k == 1 ? 1 : hoop) *
                              ((radial.slope + k * radial.value) * (along - hoop) + k * radial.value * hoop -
                               k * stress->hoop.at(portable::log(hoop)).value * along) /
                              R;
    return (acceleration(R, t) - divergence / density) * at.outwards;
  }
  /// On the rim that is nearer: a node of the surface reaches some matter, and is pressed with its mean.
  double pressure(const Vector<3>& X, double t) const
  {
    const bool is_inner = 2 * polar_place(X, cavity.centre, shells).radius < cavity.inner_radius + cavity.outer_radius;
    const double rim = is_inner ? cavity.inner_radius : cavity.outer_radius;
    return -stress->radial.at(portable::log(radius(rim, t) / rim)).value;
  }
};

StressAroundHole stress_around_hole(const Cavity& cavity, Shells shells, const MaterialModel& material)
{
  const Vector<3> direction(-cavity.shortening, 1, shells == Shells::spheres ? 1 : 0);
  const StressPath path = straight_stress_path(material, direction, portable::log(1 + cavity.expansion));
  return {{path.length, path.along_x}, {path.length, path.along_y}};
}

}  // namespace

BodyFunctions Cavity::functions(const ProblemBody& body) const
{
  const Shells shells = shells_of(*this, body);
  const CavityMotion motion{*this, shells, body.density,
                            std::make_shared<const StressAroundHole>(stress_around_hole(*this, shells, body.material))};
  BodyFunctions functions;
  functions.velocity = [](const Vector<3>&) -> Vector<3> { return Vector<3>::Zero(); };
  functions.body_force = [motion](const Vector<3>& X, double t) { return motion.body_force(X, t); };
  functions.pressure = [motion](const Vector<3>& X, double t) { return motion.pressure(X, t); };
  functions.exact_displacement = [motion](const Vector<3>& X, double t) { return motion.displacement(X, t); };
  set_region(*this, functions, shells);
  return functions;
}

}  // namespace tamp::components
