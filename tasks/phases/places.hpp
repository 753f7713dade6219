#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "components/shapes/particle_places.hpp"
#include "runtime/graph/declaration.hpp"
#include "tasks/labels.hpp"

namespace tamp::tasks
{

/// Particles whose motion goes through the kernels together: their numbers between two kernels stay in the first-level
/// cache.
inline constexpr std::size_t motion_batch = 32;

/// The particles of a task as they are at the start of the step, which all weights of the step follow from. The task
/// reads their previous positions and deformation gradients.
template <int D, class Data>
components::ParticlePlaces<D> places_at_start(const Data& data)
{
  return {data[particle::position<D>.previous()], data[particle::deformation_gradient<D>.previous()]};
}

/// The cell of the patch that holds a particle of it.
template <int D>
runtime::Index cell_of(const runtime::TaskContext& at, const Vector<D>& x)
{
  const runtime::Grid& grid = at.layout.grid();
  runtime::Index cell = at.patch.cells.lower;
  for (std::size_t k = 0; k < D; ++k) {
    const double place = std::floor((x[static_cast<int>(k)] - grid.lower[k]) / grid.cell_size);
    cell[k] = std::clamp(static_cast<int>(place), at.patch.cells.lower[k], at.patch.cells.upper[k] - 1);
  }
  return cell;
}

}  // namespace tamp::tasks
