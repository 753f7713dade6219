#include <catch2/catch.hpp>
#include <vector>

#include "components/rigid/rigid_contact.hpp"

namespace test_rigid_contact
{

using namespace tamp::components;

namespace
{

MassProperties cube(double mass)
{
  MassProperties body;
  body.mass = mass;
  body.inertia = mass / 6 * Matrix3::Identity();
  body.inverse_inertia = 6 / mass * Matrix3::Identity();
  return body;
}

struct Touched {
  double mass;
  Vector3 arm;
  Vector3 velocity;
  Vector3 normal;
};

}  // namespace

TEST_CASE("a rigid body sticks to what it hits as momentum and angular momentum have it")
{
  // However light the body is beside the nodes.
  const double mass = GENERATE(1e-3, 1.0, 1e3);
  const MassProperties body = cube(mass);
  RigidState free;
  free.momentum = mass * Vector3(0.1, 0.2, -5);
  free.angular_momentum = body.inertia * Vector3(0.3, -0.2, 0.1);
  const std::vector<Touched> nodes{{0.5, {0.3, 0.1, -0.5}, {0, 0, 1}, {0, 0, -1}},
                                   {0.2, {-0.4, 0.2, -0.5}, {0.1, 0, 0}, {0, 0, -1}},
                                   {0.4, {0.1, -0.3, -0.5}, {0, -0.1, 0}, {0, 0, -1}}};
  const RigidMotion before = motion_of(body, free);
  RigidCoupling coupling;
  for (const Touched& n : nodes) {
    coupling.add(node_contact(n.mass, n.normal, 1e9, before.at(n.arm), n.velocity), n.arm);
  }
  const RigidMotion after = coupling.solve(body, free);

  Vector3 linear = body.mass * after.velocity, angular = body.inertia * after.spin;
  Vector3 linear_before = free.momentum, angular_before = free.angular_momentum;
  for (const Touched& n : nodes) {
    linear += n.mass * after.at(n.arm);
    angular += n.arm.cross(n.mass * after.at(n.arm));
    linear_before += n.mass * n.velocity;
    angular_before += n.arm.cross(n.mass * n.velocity);
  }
  CHECK((linear - linear_before).norm() < 1e-12 * linear_before.norm());
  CHECK((angular - angular_before).norm() < 1e-12 * (angular_before.norm() + linear_before.norm()));
}

TEST_CASE("friction at a rigid body is Coulomb's, and nothing holds what parts")
{
  const Vector3 normal(0, 0, -1);
  const NodeContact parting = node_contact(2, normal, 0.5, {1, 0, 3}, {0, 0, 1});
  CHECK(parting.coupling == Matrix3::Zero());
  const NodeContact sticking = node_contact(2, normal, 0.5, {1, 0, -3}, {0, 0, 0});
  CHECK(sticking.coupling == 2 * Matrix3::Identity());
  const NodeContact sliding = node_contact(2, normal, 0.5, {4, 0, -3}, {0, 0, 0});
  const Vector3 impulse = sliding.coupling * (Vector3(4, 0, -3) - sliding.velocity);
  CHECK((impulse - Vector3(0.5 * 6, 0, -6)).norm() < 1e-14);
}

TEST_CASE("half of the nodes of a symmetric contact solve for the motion of the whole in its plane")
{
  // The whole, symmetric about z = 0, and the half of it at z > 0, whose centre lies on the plane.
  const MassProperties whole = cube(2), half = cube(1);
  RigidState of_whole, of_half;
  of_whole.momentum = {1, -4, 0};
  of_whole.angular_momentum = {0, 0, 0.3};
  of_half.momentum = 0.5 * of_whole.momentum;
  of_half.angular_momentum = 0.5 * of_whole.angular_momentum;
  const Held held{false, false, true, true, true, false};
  RigidCoupling by_whole, by_half;
  for (const double side : {-1.0, 1.0}) {
    for (const double x : {-0.3, 0.1, 0.4}) {
      const Vector3 arm(x, -0.5, 0.2 * side), normal = Vector3(0.1, -1, 0.3 * side).normalized();
      const NodeContact contact = node_contact(0.7, normal, 0.3, motion_of(whole, of_whole).at(arm), {0, 0.5, 0});
      by_whole.add(contact, arm);
      if (side > 0) by_half.add(contact, arm);
    }
  }

  const RigidMotion expected = by_whole.solve(whole, of_whole), found = by_half.solve(half, of_half, held);

  CHECK((found.velocity - expected.velocity).norm() < 1e-14);
  CHECK((found.spin - expected.spin).norm() < 1e-14);
  CHECK(found.velocity.z() == 0);
  CHECK(found.spin.head<2>() == Eigen::Vector2d::Zero());
}

TEST_CASE("without contact a rigid body keeps its motion")
{
  const MassProperties body = cube(3);
  RigidState free;
  free.momentum = {1, 2, 3};
  free.angular_momentum = {0.1, 0.2, 0.3};
  const RigidMotion motion = RigidCoupling().solve(body, free);
  CHECK((motion.velocity - free.momentum / 3).norm() < 1e-15);
  CHECK((motion.spin - angular_velocity(body, free)).norm() < 1e-15);
}

}  // namespace test_rigid_contact
