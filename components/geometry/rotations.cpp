#include "components/geometry/rotations.hpp"

#include <cmath>

#include "components/errors.hpp"
#include "components/geometry/checks.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

template <int D>
Matrix<D> plane_rotation(double angle)
{
  Matrix<D> rotation = Matrix<D>::Identity();
  rotation(0, 0) = rotation(1, 1) = portable::cos(angle);
  rotation(1, 0) = portable::sin(angle);
  rotation(0, 1) = -rotation(1, 0);
  return rotation;
}

Matrix<3> axis_rotation(const Vector<3>& axis, double angle)
{
  const double length = axis.norm();
  if (!(length > 0) || !std::isfinite(length)) throw BadValue("axis " + text<3>(axis), "an axis with a direction");
  const Vector<3> a = axis / length;
  const double cosine = portable::cos(angle), sine = portable::sin(angle);
  return cosine * Matrix<3>::Identity() + (1 - cosine) * a * a.transpose() + sine * cross_matrix(a);
}

template Matrix<2> plane_rotation<2>(double);
template Matrix<3> plane_rotation<3>(double);

}  // namespace tamp::components
