#include "runtime/storage/row_share.hpp"

namespace tamp::runtime
{

RowShare particle_share(const Warehouse& warehouse, int group, const Communicator& communicator)
{
  const PatchLayout& layout = warehouse.layout();
  const auto is_own = [&](std::size_t patch) { return warehouse.is_local(layout[static_cast<int>(patch)]); };
  // Each rank fills in its own.
  std::vector<std::uint64_t> counts(static_cast<std::size_t>(layout.size()), 0);
  for (const Patch& patch : layout) {
    const auto p = static_cast<std::size_t>(patch.id);
    if (is_own(p)) counts[p] = warehouse.n_particles(patch.id, group);
  }
  return share_by_patch(communicator.sum(std::move(counts)), is_own);
}

}  // namespace tamp::runtime
