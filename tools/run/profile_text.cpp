#include "tools/run/profile_text.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <stdexcept>

#include "runtime/profile/check_profile.hpp"
#include "runtime/profile/compare.hpp"
#include "runtime/profile/memory_table.hpp"
#include "runtime/profile/table.hpp"
#include "tools/run/run_document.hpp"
#include "tools/run/run_folder.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/suggestion.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

void expect_phase(const nlohmann::json& profile, const std::string& phase)
{
  const std::vector<std::string> phases = runtime::phases_of(profile);
  if (phases.empty()) throw std::out_of_range("tasks");
  if (phase.empty() || std::ranges::find(phases, phase) != phases.end()) return;
  const std::string any = fmt::format("expected one of {}", fmt::join(phases, ", "));
  throw InputError({"--phase", fmt::format("\"{}\"", phase), meant_or(phase, phases, any)});
}

void expect_ranks(const nlohmann::json& profile, const std::vector<std::size_t>& ranks)
{
  for (const std::size_t rank : ranks) {
    const std::size_t n = profile.at("ranks").get_ref<const nlohmann::json::array_t&>().size();
    if (n == 0) throw std::out_of_range("ranks");
    if (rank >= n) throw InputError({"--rank", std::to_string(rank), fmt::format("expected 0 to {}", n - 1)});
  }
}

std::string view_of(const nlohmann::json& profile, const ProfileView& view)
{
  expect_phase(profile, view.phase);
  expect_ranks(profile, view.ranks);
  if (view.as_json) return profile.dump(1) + "\n";
  if (view.chain) return runtime::chain_text(profile);
  if (view.patches) return runtime::patches_text(profile);
  if (view.memory) return runtime::memory_text(profile);
  const runtime::TableChoice choice{.phase = view.phase,
                                    .memory_rate = view.memory_rate ? view.memory_rate(profile) : 0};
  if (view.ranks.empty()) return runtime::to_text(profile, choice);
  std::vector<std::string> tables;
  tables.reserve(view.ranks.size());
  for (const std::size_t rank : view.ranks) tables.push_back(runtime::rank_text(profile, rank, choice));
  return fmt::format("{}", fmt::join(tables, "\n"));
}

std::string busy_text(const char* run, const nlohmann::json& profile)
{
  const std::string text = runtime::busy_text(profile);
  return text.empty() ? "" : fmt::format("{}: {}", run, text);
}

std::string comparison_of(const nlohmann::json& here, const nlohmann::json& there, const ProfileView& view)
{
  std::vector<runtime::TaskComparison> tasks = runtime::compare_profiles(here, there);
  expect_phase(here, view.phase);
  if (!view.phase.empty()) {
    std::erase_if(tasks, [&](const auto& task) { return runtime::phase_of(task.name) != view.phase; });
  }
  const std::string unlike = runtime::unlike_text(here, there) + busy_text("here", here) + busy_text("there", there);
  if (!view.as_json) return runtime::to_text(tasks) + unlike;
  // A list of tasks has no place for it.
  if (!unlike.empty()) print_err("tamp: note: {}", unlike);
  return runtime::to_json(tasks).dump(1) + "\n";
}

}  // namespace

std::string with_profile(const fs::path& run, const std::function<std::string(const nlohmann::json&)>& render)
{
  const fs::path file = run / "profile.json";
  if (!fs::exists(file) && !fs::exists(run / run_mark)) {
    throw InputError({run.string(), "no run", "expected the folder of a run"});
  }
  note_files_of_run(run);
  std::string text;
  with_run_document(file, [&](const nlohmann::json& profile) {
    runtime::check_profile(profile);
    text = render(profile);
  });
  return text;
}

std::string profile_text(const fs::path& run, const ProfileView& view)
{
  return with_profile(run, [&](const nlohmann::json& profile) {
    if (!view.other) return view_of(profile, view);
    // Beside itself, a profile that is damaged says so; after that it is the other one.
    runtime::compare_profiles(profile, profile);
    return with_profile(*view.other, [&](const nlohmann::json& other) { return comparison_of(profile, other, view); });
  });
}

}  // namespace tamp::tools
