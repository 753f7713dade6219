#pragma once

#include "components/tensors.hpp"

/// Rotations that scenes state; angles in radians.
namespace tamp::components
{

/// Rotation by `angle` from x towards y; z stays.
template <int D>
Matrix<D> plane_rotation(double angle);

/// Rotation by `angle` about an axis through the origin, right-handed. Throws BadValue for an axis of no length.
Matrix<3> axis_rotation(const Vector<3>& axis, double angle);

}  // namespace tamp::components
