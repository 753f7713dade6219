#include "components/loads/rotating_frame.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>

#include "components/errors.hpp"

namespace test_rotating_frame
{

using namespace tamp;
using namespace tamp::components;

namespace
{

const Vector<3> axis(1, -2, 2), centre(0.5, -1, 3);

/// Where what moves straight on in space is seen from a frame that has turned by w t + alpha t^2 / 2.
Vector<3> seen_from_frame(const Vector<3>& x0, const Vector<3>& velocity_in_space, double w, double alpha, double t)
{
  const double angle = w * t + 0.5 * alpha * t * t;
  return centre + Eigen::AngleAxisd(-angle, axis.normalized()) * (x0 + velocity_in_space * t - centre);
}

}  // namespace

TEST_CASE("a body at rest beside the axis of a centrifuge is thrown out by w squared r")
{
  const RotatingFrame frame(6, {2, 0, 0}, {9, 0, 5.45});

  const Vector<3> b = frame.acceleration({0.3, 0, 0}, Vector<3>::Zero(), 0);

  CHECK((b - Vector<3>(0, 0, -36 * 5.45)).norm() < 1e-12);
  CHECK(frame.work_function({0.3, 0, 0}) == Approx(0.5 * 36 * 5.45 * 5.45));
}

TEST_CASE("what moves straight on in space is accelerated in the frame by the frame's forces")
{
  const double w = 3, alpha = GENERATE(0.0, 5.0);
  const RotatingFrame frame(w, axis, centre, alpha);
  const Vector<3> x0(2, 1, 0), velocity(-4, 1, 2);
  const double t = 0.4, step = 1e-4;

  const auto at = [&](double time) { return seen_from_frame(x0, velocity, w, alpha, time); };
  const Vector<3> v = (at(t + step) - at(t - step)) / (2 * step);
  const Vector<3> a = (at(t + step) - 2 * at(t) + at(t - step)) / (step * step);

  CHECK((frame.acceleration(at(t), v, t) - a).norm() < 1e-5 * a.norm());
  CHECK(frame.is_steady() == (alpha == 0));
}

TEST_CASE("the gradients of the frame's force make up the force")
{
  const RotatingFrame frame(3, axis, centre, 5);
  const Vector<3> x(2, 1, 0), v(-4, 1, 2);
  const double t = 0.7;

  const Vector<3> b = frame.gradient_by_position(t) * (x - centre) + frame.gradient_by_velocity(t) * v;

  CHECK((frame.acceleration(x, v, t) - b).norm() < 1e-12 * b.norm());
}

TEST_CASE("a kick is the mean of the velocities before and after in the frame's force")
{
  const RotatingFrame frame(300, axis, centre, 5e3);
  const Vector<3> x(2, 1, 0), v(-4, 1, 2), other(1, 0, -9.81);
  const double t = 0.01, kick = 2e-3;

  const Vector<3> after = v + frame.velocity_change(x, v, other, t, kick);

  const Vector<3> expected = v + kick * (other + frame.acceleration(x, 0.5 * (v + after), t));
  CHECK((after - expected).norm() < 1e-13 * expected.norm());
}

TEST_CASE("the Coriolis term turns a velocity and does no work, however long the kick")
{
  const RotatingFrame frame(3, axis, centre);
  const Vector<3> v(-4, 1, 2);
  const double kick = GENERATE(1e-3, 1.0, 100.0);

  // On the axis the frame has no other force.
  const Vector<3> after = v + frame.velocity_change(centre, v, Vector<3>::Zero(), 0, kick);

  CHECK(after.norm() == Approx(v.norm()).epsilon(1e-14));
  CHECK((after - v).norm() > 1e-3);
}

TEST_CASE("a frame that turns about an axis of zero length is refused")
{
  CHECK_THROWS_AS(RotatingFrame(6, Vector<3>::Zero(), centre), BadValue);
}

}  // namespace test_rotating_frame
