#pragma once

#include <Eigen/Core>
#include <tuple>

#include "components/rigid/rigid_body.hpp"
#include "components/tensors.hpp"

namespace tamp::tasks
{

/// Sums over the matter of one body, from which its motion as a whole follows, whether it deforms or not: over its
/// particles as points, or exactly for a rigid body. In plane strain the third coordinates are 0. SI units; a slab of 1
/// m.
struct BodySums {
  double mass = 0;
  Eigen::Vector3d momentum = Eigen::Vector3d::Zero();
  /// sum m x, and sum m X of where they were at the start.
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Eigen::Vector3d reference_position = Eigen::Vector3d::Zero();
  /// sum m x x^T, sum m x X^T, sum m x cross v.
  Eigen::Matrix3d second_moment = Eigen::Matrix3d::Zero();
  Eigen::Matrix3d carried_moment = Eigen::Matrix3d::Zero();
  Eigen::Vector3d angular_momentum = Eigen::Vector3d::Zero();

  static constexpr auto fields = std::tuple{
      &BodySums::mass,          &BodySums::momentum,       &BodySums::position,        &BodySums::reference_position,
      &BodySums::second_moment, &BodySums::carried_moment, &BodySums::angular_momentum};

  /// Adds a particle.
  template <int D>
  void add(double particle_mass, const Vector<D>& x, const Vector<D>& reference, const Vector<D>& v);

  /// The rotation from the start that fits the motion best, by least squares of mass; none for a body without extent.
  Eigen::Matrix3d rotation() const;
  /// Its angle [rad]: in the plane anticlockwise, in space without a sign.
  double tilt(int dimension) const;
  /// Angular velocity of the rigid motion that has the body's angular momentum about its centre [rad/s].
  Eigen::Vector3d spin() const;
  /// Where the body carries a point that was at `reference` at the start [m].
  Eigen::Vector3d position_of(const Eigen::Vector3d& reference) const;
};

BodySums sums_of(const components::MassProperties& body, const components::RigidState& state);

}  // namespace tamp::tasks
