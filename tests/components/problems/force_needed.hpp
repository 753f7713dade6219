#pragma once

#include "components/problems/body_functions.hpp"
#include "tests/components/materials/one_particle.hpp"

/// The forces that a body's exact motion needs, by differences alone.
namespace tamp::test
{

/// The derivative of a function of one number, of fourth order.
template <class Function>
auto slope(const Function& f, double at, double step)
{
  using Value = decltype(f(at));
  return Value((8 * (f(at + step) - f(at - step)) - (f(at + 2 * step) - f(at - 2 * step))) / (12 * step));
}

/// 1 + the gradient of the exact displacement.
template <int D>
Matrix<D> differenced_gradient(const components::BodyFunctions& functions, const Vector<3>& X, double t)
{
  Matrix<D> f = Matrix<D>::Identity();
  for (int k = 0; k < D; ++k) {
    const auto along = [&](double s) -> Vector<D> {
      return functions.exact_displacement(X + s * Vector<3>::Unit(k), t).template head<D>();
    };
    f.col(k) += slope(along, 0, 1e-3);
  }
  return f;
}

/// First Piola-Kirchhoff stress of the solid's own update, P = J sigma F^-T.
template <int D, class Solid>
Matrix<D> nominal_stress(const Solid& solid, const components::BodyFunctions& functions, const Vector<3>& X, double t)
{
  const Matrix<D> f = differenced_gradient<D>(functions, X, t);
  OneParticle<D, Solid> particle{.deformation_gradient = f};
  particle.strain(solid, SymmetricTensor<D>::Zero());
  return f.determinant() * plane_part<D>(particle.stress) * f.inverse().transpose();
}

/// The force per mass that the exact motion needs [m/s^2]: its acceleration less div P / density.
template <int D, class Solid>
Vector<D> force_needed(const Solid& solid, double density, const components::BodyFunctions& functions,
                       const Vector<3>& X, double t, double time_step)
{
  const auto velocity = [&](double time) -> Vector<D> {
    const auto place = [&](double at) -> Vector<D> { return functions.exact_displacement(X, at).template head<D>(); };
    return slope(place, time, time_step);
  };
  Vector<D> force = slope(velocity, t, time_step);
  for (int k = 0; k < D; ++k) {
    const auto along = [&](double s) -> Vector<D> {
      return nominal_stress<D>(solid, functions, X + s * Vector<3>::Unit(k), t).col(k);
    };
    force -= slope(along, 0, 1e-3) / density;
  }
  return force;
}

}  // namespace tamp::test
