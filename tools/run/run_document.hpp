#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>

namespace tamp::tools
{

/// Has `use` look at the JSON of a file that a run has written. Throws FileError for a file that is missing or, as
/// `use` finds, not what a run has written.
void with_run_document(const std::filesystem::path& file,
                       const std::function<void(const nlohmann::ordered_json&)>& use);

}  // namespace tamp::tools
