#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace tamp::tools
{

/// Selects which part of a run's profile is shown, and how.
struct ProfileView {
  /// Only tasks of this phase; empty: all.
  std::string phase{};
  /// Each rank by itself; empty: all together.
  std::vector<std::size_t> ranks{};
  /// Shows the patches, the longest chain, or memory, in place of time by task.
  bool patches = false;
  bool chain = false;
  bool memory = false;
  /// The folder of another run, to compare with.
  std::optional<std::filesystem::path> other{};
  /// Gives the bytes a second that memory gives a worker, for a profile; 0 if that is not known. See TableChoice.
  std::function<double(const nlohmann::json& profile)> memory_rate{};
  /// As JSON in place of tables for people.
  bool as_json = false;
};

/// The text that `render` makes of the `profile.json` of a run. Throws InputError for a folder that is no run's, and
/// FileError for a profile that is missing or, as `render` finds, not what a run has written.
std::string with_profile(const std::filesystem::path& run,
                         const std::function<std::string(const nlohmann::json&)>& render);

/// The profile of the run in a folder, as with_profile reads it. Throws InputError for a rank or a phase that is not in
/// it, too.
std::string profile_text(const std::filesystem::path& run, const ProfileView& view = {});

}  // namespace tamp::tools
