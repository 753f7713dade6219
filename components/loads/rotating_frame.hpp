#pragma once

#include "components/tensors.hpp"

namespace tamp::components
{

/// A frame that turns about an axis fixed in space, such as a centrifuge's. What rests in the frame feels, per mass,
///
///     b(x, v) = -w x (w x r) - alpha x r - 2 w x v,   r = x - centre, w(t) = w(0) + alpha t,
///
/// the centrifugal, Euler and Coriolis terms; x and v are of the frame. Positive rates turn with the right hand about
/// the axis. m, s, rad.
class RotatingFrame
{
 public:
  /// `angular_speed` is that at time 0 [rad/s], `angular_acceleration` in rad/s^2, `centre` any point of the axis.
  /// Throws BadValue for an axis without length.
  RotatingFrame(double angular_speed, const Vector<3>& axis, const Vector<3>& centre, double angular_acceleration = 0);

  const Vector<3>& centre() const { return centre_; }
  Vector<3> angular_velocity(double time) const { return angular_velocity_ + time * angular_acceleration_; }
  /// Is w constant? Only then the centrifugal force has a potential.
  bool is_steady() const { return angular_acceleration_.isZero(0); }

  /// b is linear: b(x, v) = A (x - centre) + B v, with the gradients A = db/dx [1/s^2] and B = db/dv [1/s].
  Matrix<3> gradient_by_position(double time) const;
  Matrix<3> gradient_by_velocity(double time) const;
  Vector<3> acceleration(const Vector<3>& x, const Vector<3>& v, double time) const;

  /// Does its speed change?
  bool is_unsteady() const { return angular_acceleration_.squaredNorm() > 0; }

  /// |w x r|^2 / 2 [J/kg] at time 0: what it grows by is the work of the centrifugal force, if the frame is steady.
  double work_function(const Vector<3>& x) const;

  /// The change of velocity v over a kick [s] by another acceleration and b, where the Coriolis term takes the mean of
  /// the velocities before and after (the implicit midpoint rule): second order, and the term does no work.
  Vector<3> velocity_change(const Vector<3>& x, const Vector<3>& v, const Vector<3>& acceleration, double time,
                            double kick) const;

 private:
  /// The part of b that does not go with velocity.
  Vector<3> acceleration_at_rest(const Vector<3>& x, double time) const;

  Vector<3> angular_velocity_;
  Vector<3> angular_acceleration_;
  Vector<3> centre_;
};

}  // namespace tamp::components
