#pragma once

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The axes along which the particle of X is a box while it is not deformed, as columns: those of its sector where
/// particles lie on rings, which matters to cpdi alone, and otherwise those of the grid. A deformation gradient starts
/// with them; materials, which are the same in all directions, do not see it.
template <int D>
Matrix<D> particle_axes(const Scene& scene, const SceneBody& body, const Vector<D>& X)
{
  if constexpr (D == 2) {
    const bool in_sectors = body.functions.layout.has_value();
    if (in_sectors && scene.interpolator == Interpolator::cpdi) return body.functions.layout->axes_at(X);
  }
  return Matrix<D>::Identity();
}

}  // namespace tamp::tasks
