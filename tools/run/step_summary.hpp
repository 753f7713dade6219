#pragma once

#include <nlohmann/json.hpp>

#include "tasks/simulation.hpp"

namespace tamp::tools
{

/// Summary of what set the time steps of a run: the first, the shortest and the last that a particle set, with the
/// particle, and the number that each material and each other cause set.
nlohmann::ordered_json step_summary(const tasks::Simulation& simulation);

}  // namespace tamp::tools
