#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tamp::tools::compare
{

/// The most memory [bytes] that a process of this program has resident while it does nothing but the first steps of one
/// scene; models that share a process cannot be distinguished. None if that run fails.
///
/// To be called before this process has grown large itself: what a process starts from counts in its peak (Linux).
/// `scratch` is a folder that is made for the run and removed again.
std::optional<std::size_t> peak_rss_alone(const std::filesystem::path& scene,
                                          const std::vector<std::string>& assignments, int n_threads, long n_steps,
                                          const std::filesystem::path& scratch);

}  // namespace tamp::tools::compare
