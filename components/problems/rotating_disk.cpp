#include "components/problems/rotating_disk.hpp"

#include <fmt/core.h>

#include "components/errors.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

BodyFunctions RotatingDisk::functions(const ProblemBody& body) const
{
  if (body.dimension != 2) throw BadValue("a scene of dimension 3", "one of dimension 2, in which it is a disk");
  if (!(inner_radius < outer_radius)) {
    throw BadParameter("inner_radius", fmt::format("{}", inner_radius), "less than the outer radius");
  }
  const Vector<3> c = centre;
  const double w = angular_speed;
  const auto turned = [=](const Vector<3>& X, double t) -> Vector<3> {
    const double cosine = portable::cos(w * t), sine = portable::sin(w * t);
    const Vector<3> arm = X - c;
    return {cosine * arm[0] - sine * arm[1], sine * arm[0] + cosine * arm[1], 0};
  };
  BodyFunctions disk;
  disk.velocity = [=](const Vector<3>& X) { return Vector<3>(-w * (X[1] - c[1]), w * (X[0] - c[0]), 0); };
  disk.body_force = [=](const Vector<3>& X, double t) -> Vector<3> { return -w * w * turned(X, t); };
  disk.exact_displacement = [=](const Vector<3>& X, double t) -> Vector<3> { return turned(X, t) - (X - c); };
  disk.layout = PolarLayout{c.head<2>(), inner_radius, outer_radius};
  return disk;
}

}  // namespace tamp::components
