#pragma once

#include "tasks/simulation.hpp"
#include "tools/bench/plain_mls_mpm.hpp"

namespace tamp::tools::bench
{

/// The plain program at the start of a simulation, particle by particle: one body of a Drucker-Prager soil, free but
/// for a smooth floor.
template <int D>
PlainMlsMpm<D> plain_of(tasks::Simulation& simulation);

}  // namespace tamp::tools::bench
