#pragma once

#include <cstddef>

#include "components/shapes/particle_places.hpp"
#include "runtime/graph/declaration.hpp"
#include "tasks/cells.hpp"
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

}  // namespace tamp::tasks
