#include "components/loads/rotating_frame.hpp"

#include <Eigen/Geometry>

#include "components/errors.hpp"

namespace tamp::components
{

RotatingFrame::RotatingFrame(double angular_speed, const Vector<3>& axis, const Vector<3>& centre,
                             double angular_acceleration)
    : centre_(centre)
{
  const double length = axis.stableNorm();
  if (!(length > 0)) throw BadValue("an axis of zero length", "a direction");
  angular_velocity_ = angular_speed / length * axis;
  angular_acceleration_ = angular_acceleration / length * axis;
}

Matrix<3> RotatingFrame::gradient_by_position(double time) const
{
  const Matrix<3> w = cross_matrix(angular_velocity(time));
  return -w * w - cross_matrix(angular_acceleration_);
}

Matrix<3> RotatingFrame::gradient_by_velocity(double time) const
{
  return -2 * cross_matrix(angular_velocity(time));
}

Vector<3> RotatingFrame::acceleration_at_rest(const Vector<3>& x, double time) const
{
  const Vector<3> w = angular_velocity(time), r = x - centre_;
  return -w.cross(w.cross(r)) - angular_acceleration_.cross(r);
}

Vector<3> RotatingFrame::acceleration(const Vector<3>& x, const Vector<3>& v, double time) const
{
  return acceleration_at_rest(x, time) - 2 * angular_velocity(time).cross(v);
}

double RotatingFrame::work_function(const Vector<3>& x) const
{
  return 0.5 * angular_velocity_.cross(x - centre_).squaredNorm();
}

Vector<3> RotatingFrame::velocity_change(const Vector<3>& x, const Vector<3>& v, const Vector<3>& acceleration,
                                         double time, double kick) const
{
  // (1 + [u]) dv = kick a - 2 u x v with u = kick w; the inverse of 1 + [u] is (1 - [u] + u u^T) / (1 + u.u).
  const Vector<3> u = kick * angular_velocity(time);
  const Vector<3> right = kick * (acceleration + acceleration_at_rest(x, time)) - 2 * u.cross(v);
  return (right - u.cross(right) + u.dot(right) * u) / (1 + u.squaredNorm());
}

}  // namespace tamp::components
