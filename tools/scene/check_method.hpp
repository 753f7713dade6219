#pragma once

#include "tasks/scene.hpp"
#include "tools/scene/json/json_reader.hpp"

namespace tamp::tools
{

/// Adds a problem for each choice of method that cannot work with another of the scene: interpolator, transfer and so
/// on, which have been read.
void check_method(const JsonReader& reader, const tasks::Scene& scene);

/// Checks when stress follows the motion, once the materials have been read.
void check_stress_timing(const JsonReader& reader, const tasks::Scene& scene);

/// Checks a transfer that moves nodes by other velocities than contact and walls have left them, once the contacts have
/// been read.
void check_contact_of_transfer(const JsonReader& reader, const tasks::Scene& scene);

}  // namespace tamp::tools
