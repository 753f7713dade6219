#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/fields/field_columns.hpp"
#include "runtime/storage/fields/xdmf.hpp"

/// The steps of a field file, which stand in it as `FieldFile` says. What is given back is for its XDMF file.
namespace tamp::runtime
{

/// Adds a step to a field file whose longest list of vertices has `n_listed`. The blocks have passed `check` and
/// `place_of`. Collective; throws FileError on all
/// ranks if it failed on one; the file then has the steps that it had.
///
/// The step is built beside the tree of the file and linked into it at the very end, so that a program killed before
/// leaves the steps before untouched; only the link itself, some hundred bytes, is a moment in which it may not die.
XdmfStep add_step(const std::filesystem::path& field_file, std::int64_t step, double time,
                  std::span<const ParticleBlock> particles, const std::optional<NodeBlock>& nodes, std::size_t n_listed,
                  const Communicator& communicator);

/// Removes what comes after `last_step` and says what is left, in the order of the steps. Of one process. Throws
/// FileError for a file that is missing or damaged.
std::vector<XdmfStep> cut_to_step(const std::filesystem::path& field_file, std::int64_t last_step);

}  // namespace tamp::runtime
