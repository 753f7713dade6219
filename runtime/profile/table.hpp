#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

/// A `profile.json` as tables for people. All throw nlohmann's exceptions for what no run has written.
namespace tamp::runtime
{

/// Selects which part of a profile is shown.
struct TableChoice {
  /// Only tasks of this phase, which is what stands before the colon in their names; empty: all.
  std::string phase{};
  /// Largest number of rows; 0: all rows, and below them what workers waited for.
  int n_rows = 0;
  /// Bytes a second that memory gives one worker while all of them ask it; 0: not known, and tasks are not compared
  /// with it.
  double memory_rate = 0;
};

/// The run as a whole, most expensive task first.
std::string to_text(const nlohmann::json& profile, const TableChoice& choice = {});

/// A line on a machine that was too busy for its times to be trusted; empty for others.
std::string busy_text(const nlohmann::json& profile);

/// The profile of one rank.
std::string rank_text(const nlohmann::json& profile, std::size_t rank, const TableChoice& choice = {});

/// The dearest patches, and how the others compare.
std::string patches_text(const nlohmann::json& profile, std::size_t n_rows = 20);

/// The longest chain of the mean step, task by task and message by message.
std::string chain_text(const nlohmann::json& profile);

/// The phases of all tasks, in the order of their most expensive tasks.
std::vector<std::string> phases_of(const nlohmann::json& profile);
std::string phase_of(const std::string& task);

}  // namespace tamp::runtime
