#include "components/problems/axis_aligned.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

#include "components/errors.hpp"
#include "tests/components/materials/one_particle.hpp"

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double K = 8333, G = 3846, density = 1.3;
const MaterialModel material = NeoHookean{K, G};

/// As in the literature, but for the place: the unit cube, strains up to 0.16.
AxisAligned problem_of(int n_axes)
{
  return {.amplitude = 0.05, .length = 1, .n_axes = n_axes, .origin = {0.3, -0.2, 0.1}};
}

/// The derivative of a function of one number, of fourth order.
template <class Function>
auto slope(const Function& f, double at, double step)
{
  using Value = decltype(f(at));
  return Value((8 * (f(at + step) - f(at - step)) - (f(at + 2 * step) - f(at - 2 * step))) / (12 * step));
}

/// 1 + the gradient of the exact displacement, by differences.
template <int D>
Matrix<D> differenced_gradient(const BodyFunctions& functions, const Vector<3>& X, double t)
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
template <int D>
Matrix<D> nominal_stress(const BodyFunctions& functions, const Vector<3>& X, double t)
{
  const Matrix<D> f = differenced_gradient<D>(functions, X, t);
  test::OneParticle<D, NeoHookean> particle{.deformation_gradient = f};
  particle.strain(std::get<NeoHookean>(material), SymmetricTensor<D>::Zero());
  return f.determinant() * plane_part<D>(particle.stress) * f.inverse().transpose();
}

/// What force per mass the exact motion needs: its acceleration less div P / density.
template <int D>
Vector<D> force_needed(const BodyFunctions& functions, const Vector<3>& X, double t)
{
  const double step = 1e-5;
  const auto at = [&](double time) -> Vector<D> { return functions.exact_displacement(X, time).template head<D>(); };
  Vector<D> force = (at(t + step) - 2 * at(t) + at(t - step)) / (step * step);
  for (int k = 0; k < D; ++k) {
    const auto along = [&](double s) -> Vector<D> {
      return nominal_stress<D>(functions, X + s * Vector<3>::Unit(k), t).col(k);
    };
    force -= slope(along, 0, 1e-3) / density;
  }
  return force;
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("the axis-aligned body force is what the neo-Hookean solid needs to move as the exact solution",
                       "", ((int D), D), 2, 3)
{
  const int n_axes = GENERATE(range(1, D + 1));
  const AxisAligned problem = problem_of(n_axes);
  const BodyFunctions functions = problem.functions({D, density, material});
  std::mt19937 random(5);
  std::uniform_real_distribution<double> uniform(0.05, 0.95);
  double largest = 0;
  for (int sample = 0; sample < 40; ++sample) {
    const Vector<3> X = problem.origin + Vector<3>(uniform(random), uniform(random), D == 3 ? uniform(random) : 0.0);
    const double t = 0.02 * uniform(random);

    const Vector<D> force = functions.body_force(X, t).template head<D>();

    const Vector<D> needed = force_needed<D>(functions, X, t);
    // (pi / L)^2 A E / density is what the acceleration comes to.
    const double scale = 9.87 * 0.05 * 1e4 / density;
    REQUIRE((force - needed).norm() < 1e-5 * scale);
    largest = std::max(largest, force.norm());
  }
  CHECK(largest > 500);
}

TEST_CASE("the axis-aligned solution starts where its displacement, deformation and velocity say")
{
  const AxisAligned problem = problem_of(3);
  const BodyFunctions functions = problem.functions({3, density, material});
  const Vector<3> X(0.55, 0.15, 0.8);

  const auto in_time = [&](double t) { return functions.exact_displacement(X, t); };
  CHECK((functions.displacement(X) - in_time(0)).norm() < 1e-15);
  CHECK((functions.deformation_gradient(X) - differenced_gradient<3>(functions, X, 0)).norm() < 1e-9);
  CHECK((functions.velocity(X) - slope(in_time, 0, 1e-5)).norm() < 1e-8 * functions.velocity(X).norm());
  // The second axis starts displaced; the walls hold what is on them.
  CHECK(functions.displacement(X)[1] == Approx(0.05 * std::sin(3.14159265358979 * 0.35) * std::sqrt(0.75)));
  CHECK(std::abs(functions.exact_displacement(problem.origin, 0.003).norm()) < 1e-16);
}

TEST_CASE("the axis-aligned solution is refused for what it is not made for")
{
  CHECK_THROWS_AS(problem_of(2).functions({2, density, Hypoelastic{K, G}}), BadValue);
  CHECK_THROWS_AS(problem_of(3).functions({2, density, material}), BadParameter);
  CHECK_THROWS_AS((AxisAligned{.amplitude = 0.32, .length = 1, .n_axes = 1}.functions({2, density, material})),
                  BadParameter);
  CHECK_NOTHROW(AxisAligned{.amplitude = 0.31, .length = 1, .n_axes = 1}.functions({2, density, material}));
}
