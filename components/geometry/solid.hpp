#pragma once

#include <type_traits>
#include <utility>
#include <variant>

#include "components/tensors.hpp"

/// The regions that bodies fill at set-up. Lengths in m, angles in radians. A solid answers exactly, without a mesh.
namespace tamp::components
{

/// Box with faces along the axes; half open, lower <= x < upper, so that boxes that share a face share no point.
template <int D>
struct Box {
  Vector<D> lower;
  Vector<D> upper;
};

/// Disk in the plane, sphere in space; open: a point at the radius is outside.
template <int D>
struct Ball {
  Vector<D> centre;
  double radius;
};

/// Box of edge lengths `sides` turned about its centre: its local axes are the columns of `rotation`. Half open in
/// its local axes.
template <int D>
struct RotatedBox {
  Vector<D> centre;
  Vector<D> sides;
  Matrix<D> rotation;
};

/// Right circular cylinder between the centres of its two ends; it holds its first end and not its second, and no
/// point at its radius.
struct Cylinder {
  Vector<3> first_end;
  Vector<3> second_end;
  double radius;
};

/// Rotation by `angle` from x towards y; z stays.
template <int D>
Matrix<D> plane_rotation(double angle);

/// Any of the shapes above, by value. It is evaluated only at set-up: per cell and particle site, never in a step.
template <int D>
class Solid
{
 public:
  using Shape = std::conditional_t<D == 3, std::variant<Box<D>, Ball<D>, RotatedBox<D>, Cylinder>,
                                   std::variant<Box<D>, Ball<D>, RotatedBox<D>>>;

  /// Throws BadValue for an empty shape, a number that is not finite, or a rotation that is none.
  explicit Solid(Shape shape);

  bool contains(const Vector<D>& x) const;

  /// The smallest axis-aligned box around the solid.
  Box<D> bounding_box() const;

  /// Volume [m^3]; in the plane the area [m^2], the volume of one metre of thickness.
  double volume() const;

 private:
  Shape shape_;
};

extern template class Solid<2>;
extern template class Solid<3>;

}  // namespace tamp::components
