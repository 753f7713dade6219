#pragma once

#include "tasks/method.hpp"
#include "tasks/set_up/fill_bodies.hpp"

namespace tamp::tasks
{

/// The longest first step that is stable, before the multiplier [s]: the shortest of the bounds of all bodies, each by
/// itself, and of those that approach each other.
template <int D>
double initial_stable_step(const Method<D>& method, const BodyParticles<D>& particles);

}  // namespace tamp::tasks
