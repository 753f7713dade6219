#pragma once

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The axes along which the particle of X is a box while it is not deformed, as columns: those of its sector where
/// particles lie on rings, which matters to dense stencils alone, and otherwise those of the grid. A deformation
/// gradient starts with them; materials, which are the same in all directions, do not see it.
template <int D>
Matrix<D> particle_axes(const Scene& scene, const SceneBody& body, const Vector<D>& X)
{
  if constexpr (D == 2) {
    const bool in_sectors = body.functions.layout.has_value();
    const bool have_axes = components::with_shape<D>(
        scene.interpolator, 1, []<class Shape>(const Shape&) { return components::Dense<Shape>; });
    if (in_sectors && have_axes) return body.functions.layout->axes_at(X);
  }
  return Matrix<D>::Identity();
}

}  // namespace tamp::tasks
