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
  matrix += node_velocity.transpose() * contact.coupling * node_velocity;
  right_side += node_velocity.transpose() * (contact.coupling * contact.velocity);
}

namespace
{

/// Puts in place of the equations of components that are held, that they are those of the free motion.
void hold(const Held& held, const MassProperties& body, const RigidState& free, RigidCoupling::Matrix6& with_body,
          RigidCoupling::Vector6& momenta)
{
  const Matrix3 inertia = inertia_now(body, free);
  const Vector3 spin = angular_velocity(body, free);
  for (int k = 0; k < 3; ++k) {
    const auto translation = static_cast<std::size_t>(k), rotation = translation + 3;
    if (held[translation]) {
      with_body.row(k).setZero();
      with_body(k, k) = body.mass;
      momenta[k] = free.momentum[k];
    }
    if (held[rotation]) {
      with_body.row(k + 3).setZero();
      with_body(k + 3, k + 3) = inertia(k, k);
      momenta[k + 3] = inertia(k, k) * spin[k];
    }
  }
}

}  // namespace

RigidMotion RigidCoupling::solve(const MassProperties& body, const RigidState& free, const Held& held) const
{
  if (held == all_held) return motion_of(body, free);
  Matrix6 with_body = matrix;
  with_body.topLeftCorner<3, 3>() += body.mass * Matrix3::Identity();
  with_body.bottomRightCorner<3, 3>() += inertia_now(body, free);
  Vector6 momenta = right_side;
  momenta.head<3>() += free.momentum;
  momenta.tail<3>() += free.angular_momentum;
  if (held != nothing_held) hold(held, body, free, with_body, momenta);
  // Scaled so that momenta and angular momenta pivot alike.
  const Vector6 scale = with_body.diagonal().cwiseSqrt().cwiseInverse();
  const Matrix6 scaled = scale.asDiagonal() * with_body * scale.asDiagonal();
  const Vector6 velocities = scale.cwiseProduct(scaled.partialPivLu().solve(scale.cwiseProduct(momenta)));
  return {free.centre, velocities.head<3>(), velocities.tail<3>()};
}

}  // namespace tamp::components
