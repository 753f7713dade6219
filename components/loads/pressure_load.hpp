#pragma once

#include <limits>
#include <vector>

#include "components/tensors.hpp"

namespace tamp::components
{

/// A pressure against time, compression positive.
class PressureCurve
{
 public:
  struct Point {
    double time;      ///< s
    double pressure;  ///< Pa
  };

  /// Straight between the points, and constant before the first and after the last. Throws BadValue, with the row,
  /// unless there is a point, all times ascend, and no pressure is below 0.
  explicit PressureCurve(std::vector<Point> points);

  double at(double time) const;

 private:
  std::vector<Point> points_;
};

/// A number for each axis k and each way that faces normal to it look: (k, 0) against the axis, (k, 1) along it.
template <int D>
using ByFace = Eigen::Matrix<double, D, 2>;

/// A box that says which part of a surface is pressed: that of the matter which starts in it. By default all.
///
/// A node of the surface reaches matter up to `depth` beneath it, and all of that tells whether the node is pressed. So
/// of faces that look along an axis it is asked with the box that much longer at the end from which they look: a box
/// that only just holds the top of a block has all of the top pressed, and nothing of the sides.
template <int D>
struct PressedBox {
  Vector<D> lower = Vector<D>::Constant(-std::numeric_limits<double>::infinity());
  Vector<D> upper = Vector<D>::Constant(std::numeric_limits<double>::infinity());

  /// The part (0 to 1) of a particle that counts as in the box; it is the cube of this size around `centre` [m].
  ByFace<D> part_of(const Vector<D>& centre, double size, double depth) const;
};

/// sum m_p P_p S_ip [kg Pa], P_p being the pressure on a particle.
template <int D>
struct PressureSums {
  ByFace<D> values = ByFace<D>::Zero();

  void add(const ByFace<D>& share) { values += share; }
  PressureSums& operator+=(const PressureSums& other)
  {
    values += other.values;
    return *this;
  }
  /// The image behind a wall is pressed as the matter before it, and its faces look the other way.
  PressureSums mirrored(int axis) const
  {
    PressureSums image = *this;
    image.values.row(axis).reverseInPlace();
    return image;
  }
};

/// The force on a node of this mass [kg] whose surface gradient is sum V_p grad S_ip [m^(D-1)]: -P sum V_p grad S_ip,
/// where P is the mean over the matter of the node [N]. Stress -P in that matter balances it, however its particles
/// lie.
template <int D>
Vector<D> pressure_force(const PressureSums<D>& pressure, double mass, const Vector<D>& surface_gradient)
{
  Vector<D> force = Vector<D>::Zero();
  if (!(mass > 0)) return force;
  for (int k = 0; k < D; ++k) {
    force[k] = -pressure.values(k, surface_gradient[k] > 0 ? 1 : 0) / mass * surface_gradient[k];
  }
  return force;
}

extern template struct PressedBox<2>;
extern template struct PressedBox<3>;

}  // namespace tamp::components
