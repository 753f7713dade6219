#include "components/problems/rotating_disk.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"

namespace test_rotating_disk
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a rotating disk's force is the acceleration of its motion")
{
  const MaterialModel material = Hypoelastic{1e6, 1e6};
  const RotatingDisk problem{.centre = {1, 2, 0}, .outer_radius = 0.5, .angular_speed = 3};
  const BodyFunctions disk = problem.functions({2, 1000, material});
  const Vector<3> X(1.3, 2.1, 0);
  const double t = 0.4, step = 1e-4;
  const auto u = [&](double time) { return disk.exact_displacement(X, time); };

  const Vector<3> acceleration = (u(t + step) - 2 * u(t) + u(t - step)) / (step * step);

  CHECK((disk.body_force(X, t) - acceleration).norm() < 1e-6);
  CHECK(acceleration.norm() == Approx(9 * std::sqrt(0.1)));
  CHECK((disk.velocity(X) - (u(step) - u(-step)) / (2 * step)).norm() < 1e-6);
  // Anticlockwise.
  CHECK(disk.velocity({1.5, 2, 0})[1] == Approx(1.5));
  CHECK_THROWS_AS(problem.functions({3, 1000, material}), BadValue);
  CHECK_THROWS_AS(
      (RotatingDisk{.centre = {1, 2, 0}, .outer_radius = 0.5, .angular_speed = 3, .inner_radius = 0.5}.functions(
          {2, 1000, material})),
      BadParameter);
}

}  // namespace test_rotating_disk
