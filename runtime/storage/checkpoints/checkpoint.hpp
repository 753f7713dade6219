#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/warehouse/warehouse.hpp"

/// A checkpoint is one file of all that a run needs to go on bit for bit, on any number of ranks: the state of every
/// patch, and bytes of the host's own. All calls are collective, and what fails on one rank throws on all.
namespace tamp::runtime
{

/// What a checkpoint is of.
struct CheckpointHeader {
  std::int64_t step = 0;
  /// [s]
  double time = 0;
  /// Tells one scene from another; given by the host, who decides what it means when it differs.
  std::string fingerprint;
};

/// Writes `step_00001234.h5` into the folder, whole or not at all, and on the disk when this returns; then removes all
/// but the newest `keep` (1 at least). Those of later steps go too: a run that resumed before them writes them again.
/// `host` is the same on all ranks. Throws FileError, for a full disk too; what was in the folder is then still there.
void write_checkpoint(const std::filesystem::path& folder, const CheckpointHeader& header,
                      std::span<const std::byte> host, Warehouse& warehouse,
                      const std::vector<std::string>& group_names, int keep, const Communicator& communicator = {});

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
