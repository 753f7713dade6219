#include "components/geometry/solid.hpp"

#include <cmath>
#include <numbers>
#include <sstream>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{
namespace
{

template <int D>
std::string text(const Matrix<D>& m)
{
  std::ostringstream out;
  out << m.format(Eigen::IOFormat(6, Eigen::DontAlignCols, ", ", ", ", "[", "]", "[", "]"));
  return out.str();
}

template <int D>
std::string text(const Vector<D>& v)
{
  std::ostringstream out;
  out << v.transpose().format(Eigen::IOFormat(6, Eigen::DontAlignCols, ", ", ", ", "", "", "[", "]"));
  return out.str();
}

template <int D>
void require_finite(const Vector<D>& v, const char* name)
{
  if (!v.allFinite()) throw BadValue(std::string(name) + " " + text<D>(v), "finite coordinates");
}

void require_positive(double value, const char* name)
{
  if (!(value > 0) || !std::isfinite(value)) {
    throw BadValue(std::string(name) + " " + std::to_string(value), "a finite length above 0");
  }
}

template <int D>
void check(const Box<D>& box)
{
  require_finite<D>(box.lower, "lower corner");
  require_finite<D>(box.upper, "upper corner");
  if (!(box.lower.array() < box.upper.array()).all()) {
    throw BadValue("box from " + text<D>(box.lower) + " to " + text<D>(box.upper), "lower < upper along every axis");
  }
}

template <int D>
void check(const Ball<D>& ball)
{
  require_finite<D>(ball.centre, "centre");
  require_positive(ball.radius, "radius");
}

template <int D>
void check(const RotatedBox<D>& box)
{
  require_finite<D>(box.centre, "centre");
  for (int k = 0; k < D; ++k) require_positive(box.sides[k], "side");
  const double departure = (box.rotation.transpose() * box.rotation - Matrix<D>::Identity()).norm();
  if (!(departure < 1e-9) || box.rotation.determinant() < 0) {
    throw BadValue("rotation " + text<D>(box.rotation), "an orthogonal matrix of determinant 1");
  }
}

void check(const Cylinder& cylinder)
{
  require_finite<3>(cylinder.first_end, "first end");
  require_finite<3>(cylinder.second_end, "second end");
  require_positive(cylinder.radius, "radius");
  require_positive((cylinder.second_end - cylinder.first_end).norm(), "length");
}

template <int D>
bool holds(const Box<D>& box, const Vector<D>& x)
{
  return (box.lower.array() <= x.array()).all() && (x.array() < box.upper.array()).all();
}

template <int D>
bool holds(const Ball<D>& ball, const Vector<D>& x)
{
  return (x - ball.centre).squaredNorm() < ball.radius * ball.radius;
}

template <int D>
bool holds(const RotatedBox<D>& box, const Vector<D>& x)
{
  const Vector<D> local = box.rotation.transpose() * (x - box.centre);
  return holds<D>(Box<D>{-0.5 * box.sides, 0.5 * box.sides}, local);
}

bool holds(const Cylinder& cylinder, const Vector<3>& x)
{
  const Vector<3> axis = cylinder.second_end - cylinder.first_end;
  const Vector<3> from_end = x - cylinder.first_end;
  const double along = from_end.dot(axis) / axis.squaredNorm();
  return along >= 0 && along < 1 && (from_end - along * axis).squaredNorm() < cylinder.radius * cylinder.radius;
}

template <int D>
Box<D> bounds(const Box<D>& box)
{
  return box;
}

template <int D>
Box<D> bounds(const Ball<D>& ball)
{
  return {ball.centre - Vector<D>::Constant(ball.radius), ball.centre + Vector<D>::Constant(ball.radius)};
}

template <int D>
Box<D> bounds(const RotatedBox<D>& box)
{
  const Vector<D> reach = 0.5 * (box.rotation.cwiseAbs() * box.sides);
  return {box.centre - reach, box.centre + reach};
}

Box<3> bounds(const Cylinder& cylinder)
{
  // The rim of an end reaches r sqrt(1 - a_k^2) along axis k from its centre, a the unit vector of the cylinder's axis.
  const Vector<3> a = (cylinder.second_end - cylinder.first_end).normalized();
  const Vector<3> rim = cylinder.radius * (1 - a.array().square()).max(0).sqrt().matrix();
  return {cylinder.first_end.cwiseMin(cylinder.second_end) - rim,
          cylinder.first_end.cwiseMax(cylinder.second_end) + rim};
}

template <int D>
double measure(const Box<D>& box)
{
  return (box.upper - box.lower).prod();
}

template <int D>
double measure(const Ball<D>& ball)
{
  const double disk = std::numbers::pi * ball.radius * ball.radius;
  return D == 2 ? disk : 4.0 / 3.0 * disk * ball.radius;
}

template <int D>
double measure(const RotatedBox<D>& box)
{
  return box.sides.prod();
}

double measure(const Cylinder& cylinder)
{
  return std::numbers::pi * cylinder.radius * cylinder.radius * (cylinder.second_end - cylinder.first_end).norm();
}

}  // namespace

template <int D>
Matrix<D> plane_rotation(double angle)
{
  Matrix<D> rotation = Matrix<D>::Identity();
  rotation(0, 0) = rotation(1, 1) = std::cos(angle);
  rotation(1, 0) = std::sin(angle);
  rotation(0, 1) = -rotation(1, 0);
  return rotation;
}

template <int D>
Solid<D>::Solid(Shape shape) : shape_(std::move(shape))
{
  std::visit([](const auto& s) { check(s); }, shape_);
}

template <int D>
bool Solid<D>::contains(const Vector<D>& x) const
{
  return std::visit([&x](const auto& s) { return holds(s, x); }, shape_);
}

template <int D>
Box<D> Solid<D>::bounding_box() const
{
  return std::visit([](const auto& s) { return bounds(s); }, shape_);
}

template <int D>
double Solid<D>::volume() const
{
  return std::visit([](const auto& s) { return measure(s); }, shape_);
}

template Matrix<2> plane_rotation<2>(double);
template Matrix<3> plane_rotation<3>(double);
template class Solid<2>;
template class Solid<3>;

}  // namespace tamp::components
