#include "components/rigid/rigid_contact.hpp"

#include <Eigen/LU>

namespace tamp::components
{

NodeContact node_contact(double mass, const Vector3& normal, double friction, const Vector3& free,
                         const Vector3& velocity)
{
  const Vector3 relative = free - velocity;
  const double approach = relative.dot(normal);
  if (!(approach > 0)) return {Matrix3::Zero(), velocity};
  const Vector3 sliding = relative - approach * normal;
  const double speed = sliding.norm();
  if (speed <= friction * approach) return {mass * Matrix3::Identity(), velocity};
  return {mass * (normal + friction / speed * sliding) * normal.transpose(), velocity};
}

void RigidCoupling::add(const NodeContact& contact, const Vector3& arm)
{
  Eigen::Matrix<double, 3, 6> node_velocity;
  node_velocity << Matrix3::Identity(), -cross_matrix(arm);
  matrix_ += node_velocity.transpose() * contact.coupling * node_velocity;
  right_side_ += node_velocity.transpose() * (contact.coupling * contact.velocity);
}

void RigidCoupling::combine(const RigidCoupling& other)
{
  matrix_ += other.matrix_;
  right_side_ += other.right_side_;
}

RigidMotion RigidCoupling::solve(const MassProperties& body, const RigidState& free, Held held) const
{
  if (held == Held::all) return motion_of(body, free);
  Matrix6 matrix = matrix_;
  matrix.topLeftCorner<3, 3>() += body.mass * Matrix3::Identity();
  matrix.bottomRightCorner<3, 3>() += inertia_now(body, free);
  Vector6 right_side = right_side_;
  right_side.head<3>() += free.momentum;
  right_side.tail<3>() += free.angular_momentum;
  if (held == Held::translation) {
    matrix.topRows<3>().setZero();
    matrix.topLeftCorner<3, 3>() = body.mass * Matrix3::Identity();
    right_side.head<3>() = free.momentum;
  }
  // Scaled so that momenta and angular momenta pivot alike.
  const Vector6 scale = matrix.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6 scaled = scale.asDiagonal() * matrix * scale.asDiagonal();
  const Vector6 velocities = scale.cwiseProduct(scaled.partialPivLu().solve(scale.cwiseProduct(right_side)));
  return {free.centre, velocities.head<3>(), velocities.tail<3>()};
}

}  // namespace tamp::components
