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

/// The solution and its derivatives at any place and time; 0 along the axes that do not move.
class AlignedMotion
{
 public:
  AlignedMotion(const AxisAligned& given, const NeoHookean& solid, double density)
      : given_(given), solid_(solid), density_(density), k_(pi / given.length)
  {
    const double K = solid.bulk_modulus, G = solid.shear_modulus, E = 9 * K * G / (3 * K + G);
    omega_ = k_ * std::sqrt(E / density);
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
    const Vector<3> u = displacement(X, t), l = stretches(X, t);
    const double J = l.prod(), T = l.squaredNorm();
    const double shear = solid_.shear_modulus * portable::pow(J, -2.0 / 3.0);
    return of_axes([&](int i) {
      const double square = l[i] * l[i];
      const double modulus =
          0.5 * solid_.bulk_modulus * (J * J + 1) / square + shear * (5.0 / 9.0 * T / square - 1.0 / 3.0);
      return u[i] * (k_ * k_ * modulus / density_ - omega_ * omega_);
    });
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
  NeoHookean solid_;
  double density_;
  double k_;      ///< rad/m
  double omega_;  ///< rad/s
};

}  // namespace

BodyFunctions AxisAligned::functions(const ProblemBody& body) const
{
  const auto* solid = std::get_if<NeoHookean>(&body.material);
  if (solid == nullptr) throw BadValue("another material", "one of type neo_hookean, for which it is made");
  if (n_axes > body.dimension) {
    throw BadParameter("n_axes", std::to_string(n_axes),
                       "at most the scene's dimension, " + std::to_string(body.dimension));
  }
  if (!(pi * amplitude < length)) {
    throw BadParameter("amplitude", fmt::format("{}", amplitude),
                       "less than length / pi, as more turns the body inside out");
  }
  const AlignedMotion motion(*this, *solid, body.density);
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

}  // namespace tamp::components
