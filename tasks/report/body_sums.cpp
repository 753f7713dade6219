#include "tasks/report/body_sums.hpp"

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>

#include "components/kinematics/polar_rotation.hpp"
#include "components/portable_math.hpp"

namespace tamp::tasks
{

namespace
{

/// Below this part of what it may be, a determinant says that a body has no extent along some axis.
constexpr double least_extent = 1e-12;

/// A body in the plane gets an extent across it, which is not turned.
Eigen::Matrix3d with_thickness(Eigen::Matrix3d moment)
{
  const double largest = moment.cwiseAbs().maxCoeff();
  if (moment.col(2).isZero(0)) moment(2, 2) = largest;
  return moment;
}

}  // namespace

/// In the plane without the third coordinates, as rows of the history add up every particle.
template <int D>
void BodySums::add(double particle_mass, const Vector<D>& x, const Vector<D>& reference, const Vector<D>& v)
{
  mass += particle_mass;
  momentum.head<D>() += particle_mass * v;
  position.head<D>() += particle_mass * x;
  reference_position.head<D>() += particle_mass * reference;
  second_moment.topLeftCorner<D, D>() += particle_mass * x * x.transpose();
  carried_moment.topLeftCorner<D, D>() += particle_mass * x * reference.transpose();
  if constexpr (D == 2) {
    angular_momentum.z() += particle_mass * (x[0] * v[1] - x[1] * v[0]);
  } else {
    angular_momentum += particle_mass * x.cross(v);
  }
}

template void BodySums::add<2>(double, const Vector<2>&, const Vector<2>&, const Vector<2>&);
template void BodySums::add<3>(double, const Vector<3>&, const Vector<3>&, const Vector<3>&);

Eigen::Matrix3d BodySums::rotation() const
{
  const Eigen::Matrix3d moment = with_thickness(carried_moment - position * reference_position.transpose() / mass);
  const double scale = moment.cwiseAbs().maxCoeff();
  if (!(moment.determinant() > least_extent * scale * scale * scale)) return Eigen::Matrix3d::Identity();
  return components::polar_rotation(moment);
}

double BodySums::tilt(int dimension) const
{
  const Eigen::Matrix3d turn = rotation();
  if (dimension == 2) return portable::atan2(turn(1, 0), turn(0, 0));
  const Eigen::Vector3d twice_axial(turn(2, 1) - turn(1, 2), turn(0, 2) - turn(2, 0), turn(1, 0) - turn(0, 1));
  return portable::atan2(twice_axial.norm(), turn.trace() - 1);
}

Eigen::Vector3d BodySums::spin() const
{
  const Eigen::Matrix3d moment = with_thickness(second_moment - position * position.transpose() / mass);
  const Eigen::Matrix3d inertia = moment.trace() * Eigen::Matrix3d::Identity() - moment;
  const double scale = inertia.cwiseAbs().maxCoeff();
  if (!(inertia.determinant() > least_extent * scale * scale * scale)) return Eigen::Vector3d::Zero();
  return inertia.inverse() * (angular_momentum - position.cross(momentum) / mass);
}

Eigen::Vector3d BodySums::position_of(const Eigen::Vector3d& reference) const
{
  return position / mass + rotation() * (reference - reference_position / mass);
}

BodySums sums_of(const components::MassProperties& body, const components::RigidState& state)
{
  const Eigen::Matrix3d turn = state.orientation.toRotationMatrix();
  const Eigen::Matrix3d carried = turn * body.second_moment();
  BodySums sums;
  sums.mass = body.mass;
  sums.momentum = state.momentum;
  sums.position = body.mass * state.centre;
  sums.reference_position = body.mass * body.centre;
  sums.second_moment = carried * turn.transpose() + sums.position * state.centre.transpose();
  sums.carried_moment = carried + sums.position * body.centre.transpose();
  sums.angular_momentum = state.angular_momentum + state.centre.cross(state.momentum);
  return sums;
}

}  // namespace tamp::tasks
