#pragma once

#include "components/tensors.hpp"

namespace tamp::components
{

/// The velocity of a node on a wall with Coulomb's friction [m/s]. The wall is normal to `axis`, and lies on the side
/// `outside`, -1 or +1. Motion into it is stopped, and motion along it loses at most friction times as much; a node
/// that leaves the wall is free.
template <int D>
Vector<D> velocity_on_rough_wall(const Vector<D>& velocity, int axis, int outside, double friction)
{
  const double approach = outside * velocity[axis];
  if (!(approach > 0)) return velocity;
  Vector<D> along = velocity;
  along[axis] = 0;
  const double speed = along.norm();
  if (speed <= friction * approach) return Vector<D>::Zero();
  return (1 - friction * approach / speed) * along;
}

}  // namespace tamp::components
