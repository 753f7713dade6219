#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

namespace tamp::runtime
{

/// Consecutive rows of a table.
struct RowRun {
  std::size_t first = 0;
  std::size_t n = 0;
};

/// Which rows of a table that all ranks write together one rank gives, in the order in which it has them. No row is
/// given twice.
struct RowShare {
  std::size_t n_total = 0;
  std::vector<RowRun> runs;

  std::size_t n_own() const
  {
    std::size_t n = 0;
    for (const RowRun& run : runs) n += run.n;
    return n;
  }
};

/// The share of a rank in a table whose rows stand in the order of the patches; rows that follow each other are one
/// run. `n_rows` and `is_own` go by patch.
template <class IsOwn>
RowShare share_by_patch(std::span<const std::uint64_t> n_rows, IsOwn&& is_own)
{
  RowShare share;
  for (std::size_t patch = 0; patch < n_rows.size(); ++patch) {
    const std::size_t first = share.n_total;
    share.n_total += n_rows[patch];
    if (n_rows[patch] == 0 || !is_own(patch)) continue;
    const bool follows = !share.runs.empty() && share.runs.back().first + share.runs.back().n == first;
    if (!follows) share.runs.push_back({first, 0});
    share.runs.back().n += n_rows[patch];
  }
  return share;
}

/// How many particles of a group each patch has, whatever rank it is on. Collective. Throws GraphError for a
/// warehouse on other ranks than the communicator's.
std::vector<std::uint64_t> particles_by_patch(const Warehouse& warehouse, int group, const Communicator& communicator);

/// Where this rank's particles stand in a table of those of all ranks, patch after patch.
RowShare particle_share(const Warehouse& warehouse, std::span<const std::uint64_t> n_particles);

}  // namespace tamp::runtime
