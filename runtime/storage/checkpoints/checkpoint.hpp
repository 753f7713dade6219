#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/checkpoints/state_tables.hpp"
#include "runtime/warehouse/warehouse.hpp"

/// A checkpoint is one file of all that a run needs to go on bit for bit, on any number of ranks: the state of every
/// patch, and bytes of the host's own. All calls are collective, and what fails on one rank throws on all. A warehouse
/// on other ranks than the communicator's is a GraphError.
namespace tamp::runtime
{

/// Identifies a checkpoint.
struct CheckpointHeader {
  std::int64_t step = 0;
  /// [s]
  double time = 0;
  /// Tells one scene from another; given by the host, who decides what it means when it differs.
  std::string fingerprint;
};

/// The contents of a checkpoint but for the values of its tables.
struct CheckpointContents {
  CheckpointHeader header;
  std::vector<std::byte> host;
  Index n_patches{1, 1, 1};
  Index n_cells{1, 1, 1};
  std::vector<std::string> group_names;
  std::vector<CheckpointTable> tables;
};

/// Writes `step_00001234.h5` into the folder, whole or not at all, and on the disk when this returns; then removes all
/// but the newest `keep` (1 at least). Those of later steps go too: a run that resumed before them writes them again.
/// `host` is the same on all ranks. Throws FileError, for a full disk too; what was in the folder is then still there.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointHeader& header,
                      std::span<const std::byte> host, Warehouse& warehouse,
                      const std::vector<std::string>& group_names, int keep, const Communicator& communicator = {});

/// The state of all ranks at one moment, which stays while the simulation goes on; on the first rank, nothing on
/// others.
struct CheckpointCopy {
  CheckpointContents contents;
  /// The values of each table, patch after patch.
  std::vector<std::vector<std::byte>> bytes;
  /// The memory that they take, in the ledger.
  LedgerHold held;
};

/// A function that calls `work` once for each number from 0 to below `n`, in whatever order and threads.
using ForAll = std::function<void(int n, const std::function<void(int)>& work)>;

/// `for_all` shares out the copying, by table.
CheckpointCopy copy_checkpoint(const CheckpointHeader& header, std::span<const std::byte> host, Warehouse& warehouse,
                               const std::vector<std::string>& group_names, const ForAll& for_all,
                               const Communicator& communicator = {});

/// Writes the checkpoint that was copied, as above, but by this process alone. The copy is used up.
void write_checkpoint(const std::filesystem::path& folder, CheckpointCopy copy, int keep);

struct FoundCheckpoint {
  std::filesystem::path file;
  CheckpointHeader header;
  std::vector<std::byte> host;
};

/// The newest checkpoint in the folder that is whole, every byte of it looked at. Each one passed over adds a line to
/// `refused`: the file, and what was found.
std::optional<FoundCheckpoint> newest_checkpoint(const std::filesystem::path& folder, std::vector<std::string>& refused,
                                                 const Communicator& communicator = {});

/// Sets the particles and the state of this rank's patches. Throws FileError if the checkpoint is of other patches,
/// groups or labels; older ones then are too. The fingerprint is the caller's to compare.
void read_checkpoint(const FoundCheckpoint& found, Warehouse& warehouse, const std::vector<std::string>& group_names,
                     const Communicator& communicator = {});

}  // namespace tamp::runtime
