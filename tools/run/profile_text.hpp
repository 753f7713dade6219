#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace tamp::tools
{

/// What of a run's profile is wanted.
struct ProfileView {
  /// Only tasks of this phase; empty: all.
  std::string phase{};
  /// Each rank by itself; empty: all together.
  std::vector<std::size_t> ranks{};
  /// By patch in place of by task.
  bool patches = false;
  /// The folder of another run, to compare with.
  std::optional<std::filesystem::path> other{};
  /// As JSON in place of tables for people.
  bool as_json = false;
};

/// The profile of the run in a folder. Throws InputError for a folder that is no run's, a rank or a phase that is not
/// in the profile, and FileError for a profile that is missing or not what a run has written.
std::string profile_text(const std::filesystem::path& run, const ProfileView& view = {});

}  // namespace tamp::tools
