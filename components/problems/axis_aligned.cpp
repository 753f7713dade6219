#include "components/problems/axis_aligned.hpp"

#include <fmt/core.h>

#include <cmath>
#include <numbers>
#include <string>

#include "components/errors.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

constexpr double pi = std::numbers::pi;

/// M_i of the header along each axis, at the stretches l [Pa].
Vector<3> moduli_along(const NeoHookean& solid, const Vector<3>& l)
{
  const double J = l.prod(), T = l.squaredNorm();
  const double shear = solid.shear_modulus * portable::pow(J, -2.0 / 3.0);
  return l.unaryExpr([&](double stretch) {
    const double square = stretch * stretch;
    return 0.5 * solid.bulk_modulus * (J * J + 1) / square + shear * (5.0 / 9.0 * T / square - 1.0 / 3.0);
  });
}
Vector<3> moduli_along(const NeoHookeanLog& solid, const Vector<3>& l)
{
  const double G = solid.shear_modulus, of_square = G + solid.lambda() * (1 - portable::log(l.prod()));
  return l.unaryExpr([&](double stretch) { return G + of_square / (stretch * stretch); });
}

/// The solution and its derivatives at any place and time; 0 along the axes that do not move.
template <class Solid>
class AlignedMotion
{
 public:
  AlignedMotion(const AxisAligned& given, const Solid& solid, double density)
      : given_(given), solid_(solid), density_(density), k_(pi / given.length)
  {
    omega_ = k_ * std::sqrt(solid.initial_moduli().youngs_modulus() / density);
  }

  Vector<3> displacement(const Vector<3>& X, double t) const
  {
    return of_axes([&](int i) { return given_.amplitude * portable::sin(across(X, i)) * portable::sin(phase(t, i)); });
  }
  Vector<3> velocity(const Vector<3>& X, double t) const
  {
    return of_axes(
        [&](int i) { return omega_ * given_.amplitude * portable::sin(across(X, i)) * portable::cos(phase(t, i)); });
  }
  /// The diagonal of F; 1 along the axes that do not move.
  Vector<3> stretches(const Vector<3>& X, double t) const
  {
    return Vector<3>::Ones() + of_axes([&](int i) {
             return k_ * given_.amplitude * portable::cos(across(X, i)) * portable::sin(phase(t, i));
           });
  }
  Vector<3> body_force(const Vector<3>& X, double t) const
  {
    const Vector<3> u = displacement(X, t), modulus = moduli_along(solid_, stretches(X, t));
    return of_axes([&](int i) { return u[i] * (k_ * k_ * modulus[i] / density_ - omega_ * omega_); });
  }

 private:
  double across(const Vector<3>& X, int i) const { return k_ * (X[i] - given_.origin[i]); }
  double phase(double t, int i) const { return omega_ * t + 2.0 / 3.0 * pi * i; }

  template <class OfAxis>
  Vector<3> of_axes(const OfAxis& value) const
  {
    Vector<3> v = Vector<3>::Zero();
    for (int i = 0; i < given_.n_axes; ++i) v[i] = value(i);
    return v;
  }

  AxisAligned given_;
  Solid solid_;
  double density_;
  double k_;      ///< rad/m
  double omega_;  ///< rad/s
};

template <class Solid>
BodyFunctions functions_of(const AlignedMotion<Solid>& motion)
{
  BodyFunctions block;
  block.displacement = [motion](const Vector<3>& X) { return motion.displacement(X, 0); };
  block.deformation_gradient = [motion](const Vector<3>& X) -> Matrix<3> {
    return motion.stretches(X, 0).asDiagonal();
  };
  block.velocity = [motion](const Vector<3>& X) { return motion.velocity(X, 0); };
  block.body_force = [motion](const Vector<3>& X, double t) { return motion.body_force(X, t); };
  block.exact_displacement = [motion](const Vector<3>& X, double t) { return motion.displacement(X, t); };
  return block;
}

}  // namespace

BodyFunctions AxisAligned::functions(const ProblemBody& body) const
{
  if (n_axes > body.dimension) {
    throw BadParameter("n_axes", std::to_string(n_axes),
                       "at most the scene's dimension, " + std::to_string(body.dimension));
  }
  if (!(pi * amplitude < length)) {
    throw BadParameter("amplitude", fmt::format("{}", amplitude),
                       "less than length / pi, as more turns the body inside out");
  }
  if (const auto* solid = std::get_if<NeoHookean>(&body.material)) {
    return functions_of(AlignedMotion(*this, *solid, body.density));
  }
  if (const auto* solid = std::get_if<NeoHookeanLog>(&body.material)) {
    return functions_of(AlignedMotion(*this, *solid, body.density));
  }
  throw BadValue("another material", "one of type neo_hookean or neo_hookean_log, for which it is made");
}

}  // namespace tamp::components
