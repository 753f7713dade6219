#include "components/rigid/prescribed_motion.hpp"

#include <catch2/catch.hpp>

#include "components/errors.hpp"

namespace test_prescribed_motion
{

using namespace tamp::components;
using tamp::Vector;

TEST_CASE("the way is the integral of velocities on straight lines, constant before the first and after the last")
{
  const auto motion = PrescribedMotion::of_velocities({{1, {2, 0, 0}}, {3, {6, -4, 0}}});

  CHECK(motion.way(0, 1).isApprox(Vector<3>(2, 0, 0), 1e-15));
  CHECK(motion.way(1, 3).isApprox(Vector<3>(8, -4, 0), 1e-15));
  CHECK(motion.way(2, 2.5).isApprox(Vector<3>(2.25, -1.25, 0), 1e-15));
  CHECK(motion.way(0.5, 4).isApprox(Vector<3>(1 + 8 + 6, -4 - 4, 0), 1e-15));
  CHECK(motion.velocity(2).isApprox(Vector<3>(4, -2, 0), 1e-15));
  CHECK(motion.velocity(9) == Vector<3>(6, -4, 0));
}

TEST_CASE("a displacement is gone through on straight lines, with rest before and after")
{
  const auto motion = PrescribedMotion::of_displacements({{1, {0, 0, 0}}, {2, {0, 3, 0}}, {4, {0, 1, 0}}});

  CHECK(motion.way(0, 1) == Vector<3>::Zero());
  CHECK(motion.way(0, 1.5).isApprox(Vector<3>(0, 1.5, 0), 1e-15));
  CHECK(motion.way(1.5, 3).isApprox(Vector<3>(0, 0.5, 0), 1e-15));
  CHECK(motion.way(0, 9).isApprox(Vector<3>(0, 1, 0), 1e-15));
  CHECK(motion.velocity(0) == Vector<3>::Zero());
  CHECK(motion.velocity(1) == Vector<3>(0, 3, 0));
}

TEST_CASE("a motion knows the axes along which it goes, for a while or all the time")
{
  const auto motion = PrescribedMotion::of_velocities({{0, {0, 0, 0}}, {1, {0, -1, 0}}, {2, {0, 0, 0}}});

  CHECK_FALSE(motion.has_part_along(0));
  CHECK(motion.has_part_along(1));
}

TEST_CASE("times that do not ascend, and displacements that do not begin at zero, are no motion")
{
  const Vector<3> zero = Vector<3>::Zero(), one(1, 0, 0);

  CHECK_THROWS_AS(PrescribedMotion::of_velocities({}), BadValue);
  CHECK_THROWS_AS(PrescribedMotion::of_velocities({{1, zero}, {1, one}}), BadValue);
  CHECK_THROWS_AS(PrescribedMotion::of_displacements({{0, zero}}), BadValue);
  CHECK_THROWS_AS(PrescribedMotion::of_displacements({{0, one}, {1, one}}), BadValue);
}

}  // namespace test_prescribed_motion
