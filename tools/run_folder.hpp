#pragma once

#include <filesystem>

namespace tamp::tools
{

/// Makes a run's folder and all above it. A folder that holds anything is refused (InputError) unless `force`, which
/// then removes what a run writes there, and nothing else. Throws FileError for a folder that cannot be made, emptied
/// or written to.
void prepare_run_folder(const std::filesystem::path& folder, bool force);

}  // namespace tamp::tools
