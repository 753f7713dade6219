#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <span>
#include <variant>
#include <vector>

#include "runtime/data/memory_ledger.hpp"
#include "runtime/grid/patch_layout.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/fields/field_columns.hpp"

namespace tamp::runtime
{

/// Particle and node fields of one moment with values of their own, which stay while the simulation goes on. It may be
/// moved, but a copy's columns would be those of the original.
struct FieldCopy {
  using Values = std::variant<std::vector<double>, std::vector<std::int64_t>>;

  FieldCopy() = default;
  FieldCopy(FieldCopy&&) = default;
  FieldCopy& operator=(FieldCopy&&) = default;

  /// Bytes of the values, and of the largest column as it stands in a file, as one column at a time is brought into
  /// that form.
  std::size_t n_bytes() const;
  /// Has the columns show the values as they are now.
  void show_values();

  std::vector<ParticleBlock> particles;
  std::optional<NodeBlock> nodes;
  /// Values of the columns, in their order: those of the particles, block by block, then those of the nodes.
  std::deque<Values> values;
  /// How many particles of each block each patch has, whatever rank it is on.
  std::vector<std::vector<std::uint64_t>> n_particles;
  /// The memory that the values take, in the ledger.
  LedgerHold held;
};

/// The fields of all ranks as those of one, on the first rank; on others nothing is left. Collective. Throws
/// GraphError for a layout of other ranks than the communicator's.
FieldCopy gathered(FieldCopy own, const PatchLayout& layout, const Communicator& communicator);

}  // namespace tamp::runtime
