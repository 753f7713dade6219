#pragma once

#include <cstddef>
#include <span>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// Bytes of the fields of all patches and ranks, before anything is stored, for so many particles by patch, then group:
/// what is there after a step from this state. Particles that come to other patches later are not foreseen.
///
/// Node and cell fields are stored where something is written to them. Where that is, is found by going through the
/// graphs without running them.
double forecast_bytes(std::span<const TaskGraph* const> graphs, std::span<const std::size_t> n_particles,
                      int n_ranks = 1);

}  // namespace tamp::runtime
