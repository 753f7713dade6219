#pragma once

#include <cstdint>
#include <filesystem>
#include <vector>

#include "runtime/storage/xdmf.hpp"

namespace tamp::runtime
{

/// Removes from a field file what comes after `last_step` and says what is left, in the order of the steps. Of one
/// process. Throws FileError for a file that is missing or damaged.
std::vector<XdmfStep> cut_to_step(const std::filesystem::path& field_file, std::int64_t last_step);

}  // namespace tamp::runtime
