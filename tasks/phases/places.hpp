#pragma once

#include "components/shapes/particle_places.hpp"
#include "tasks/labels.hpp"

namespace tamp::tasks
{

/// The particles of a task as they are at the start of the step, which all weights of the step follow from. The task
/// reads their previous positions and deformation gradients.
template <int D, class Data>
components::ParticlePlaces<D> places_at_start(const Data& data)
{
  return {data[particle::position<D>.previous()], data[particle::deformation_gradient<D>.previous()]};
}

/// A field as this step has made it, where the task reads that, and else as it was at the start of the step.
template <class Data, class Label>
decltype(auto) newest(const Data& data, const Label& label)
{
  if constexpr (requires { data[label]; }) {
    return data[label];
  } else {
    return data[label.previous()];
  }
}

}  // namespace tamp::tasks
