#pragma once

#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// K and G of a material without strain [Pa].
components::TangentModuli initial_moduli(const SceneMaterial& material);

/// Speed of compression waves in the unstrained material [m/s].
double initial_wave_speed(const SceneMaterial& material);

}  // namespace tamp::tasks
