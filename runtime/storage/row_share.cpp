#include "runtime/storage/row_share.hpp"

#include "runtime/graph/graph_error.hpp"

namespace tamp::runtime
{

std::vector<std::uint64_t> particles_by_patch(const Warehouse& warehouse, int group, const Communicator& communicator)
{
  const PatchLayout& layout = warehouse.layout();
  expect_ranks(layout, communicator.size());
  // Each rank fills in its own.
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(layout.size()), 0);
  for (const Patch& patch : layout) {
    if (warehouse.is_local(patch)) counts[static_cast<std::size_t>(patch.id)] = warehouse.n_particles(patch.id, group);
  }
  return communicator.sum(std::move(counts));
}

RowShare particle_share(const Warehouse& warehouse, std::span<const std::uint64_t> n_particles)
{
  return share_by_patch(
      n_particles, [&](std::size_t patch) { return warehouse.is_local(warehouse.layout()[static_cast<int>(patch)]); });
}

}  // namespace tamp::runtime
