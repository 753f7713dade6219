#include "components/problems/vibrating_bar.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"

namespace test_vibrating_bar
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a vibrating bar's solution is a wave that starts with its velocity")
{
  // Waves run at sqrt((60 + 4/3 30) / 4) = 5 m/s.
  const MaterialModel material = GENERATE(MaterialModel(NeoHookean{60, 30}), MaterialModel(NeoHookeanLog{60, 30}));
  const VibratingBar problem{.speed = 0.2, .wave_number = 3};
  const BodyFunctions bar = problem.functions({2, 4, material});
  const Vector<3> X(0.4, 0.7, 0);
  const double t = 0.11, step = 1e-4;

  const auto u = [&](double x, double time) { return bar.exact_displacement({x, 0.7, 0}, time)[0]; };
  const double acceleration = (u(0.4, t + step) - 2 * u(0.4, t) + u(0.4, t - step)) / (step * step);
  const double curvature = (u(0.4 + step, t) - 2 * u(0.4, t) + u(0.4 - step, t)) / (step * step);
  CHECK(acceleration == Approx(25 * curvature).epsilon(1e-4));
  CHECK(std::abs(acceleration) > 0.5);
  CHECK((u(0.4, step) - u(0.4, -step)) / (2 * step) == Approx(bar.velocity(X)[0]).epsilon(1e-6));
  CHECK(bar.velocity(X)[0] == Approx(0.2 * std::sin(1.2)));
  CHECK(bar.exact_displacement(X, 0).norm() == 0);
  const BodyFunctions drifting = VibratingBar{0.2, 3, 1.5}.functions({2, 4, material});
  CHECK(drifting.velocity(X)[0] == Approx(bar.velocity(X)[0] + 1.5));
  CHECK(drifting.exact_displacement(X, t)[0] == Approx(bar.exact_displacement(X, t)[0] + 1.5 * t));
  CHECK_THROWS_AS(
      problem.functions(
          {2, 4, MaterialModel(DruckerPrager{.bulk_modulus = 60, .shear_modulus = 30, .friction_angle = 30})}),
      BadValue);
}

}  // namespace test_vibrating_bar
