#include "tools/run/checkpointing.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <cstdio>
#include <map>

#include "runtime/file_error.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

/// Parts of a resolved scene that must be the same for a restart. Files count by their content, wherever they lie.
Json essence(Json resolved, const std::vector<InputFile>& inputs)
{
  for (const char* key : {"title", "output", "limits", "inputs"}) resolved.erase(key);
  // How long steps are may change: a run that went wrong goes on in shorter ones.
  if (resolved.contains("time")) resolved["time"] = {{"rule", resolved["time"].value("rule", Json())}};
  for (const InputFile& input : inputs) {
    const JsonPointer pointer(input.pointer);
    if (!input.pointer.empty() && resolved.contains(pointer)) resolved[pointer] = nullptr;
  }
  return resolved;
}

/// The first keys of two scenes that differ, as far as the one that the run began with can be read.
std::string differing_keys(const std::filesystem::path& scene_of_run, const CheckedScene& scene)
{
  Json then;
  try {
    then = essence(parse_json(scene_of_run), scene.inputs);
  } catch (const std::exception&) {
    return "";  // the checkpoint alone tells that it is of another scene
  }
  constexpr std::size_t most = 5;
  std::vector<std::string> keys;
  for (const auto& difference : Json::diff(then, essence(scene.resolved, scene.inputs))) {
    if (keys.size() < most) keys.push_back(difference["path"].get<std::string>());
  }
  return keys.empty() ? "" : fmt::format(", which differs at {}", fmt::join(keys, ", "));
}

/// Throws unless the run may go on: each file that changed is named.
void expect_same_scene(const runtime::FoundCheckpoint& found, const CheckedScene& scene,
                       const std::filesystem::path& run_folder)
{
  const std::string own = fingerprint(scene);
  if (found.header.fingerprint == own) return;
  const Json then = json_of(found.header.fingerprint).value_or(Json());
  std::vector<Problem> changed;
  for (const InputFile& input : scene.inputs) {
    if (!then.is_object() || !then.contains("inputs") || !then["inputs"].contains(input.pointer)) continue;
    if (then["inputs"][input.pointer] == input.hash) continue;
    changed.push_back({input.file.string(), "its content has changed since the checkpoint was written",
                       fmt::format("expected the content that the run began with ({})", input.pointer)});
  }
  if (!changed.empty()) throw InputError(std::move(changed));
  throw InputError(
      {found.file.string(), "a checkpoint of another scene" + differing_keys(run_folder / "scene.json", scene),
       "expected one of this scene, of which only the title, /time but for its rule, /limits and /output may "
       "have changed"});
}

/// The checkpoints of a folder by their steps, as their names have them.
std::map<std::int64_t, std::filesystem::path> checkpoints_in(const std::filesystem::path& folder)
{
  std::map<std::int64_t, std::filesystem::path> all;
  std::error_code none;
  for (const auto& entry : std::filesystem::directory_iterator(folder, none)) {
    long long step = 0;
    const bool is_checkpoint = std::sscanf(entry.path().filename().c_str(), "step_%lld.h5", &step) == 1;
    if (is_checkpoint && entry.path().extension() == ".h5") all[step] = entry.path();
  }
  return all;
}

/// Renames the checkpoints that were refused, which are newer than the one that was found: under their names they would
/// count as kept.
void set_aside_newer(const std::filesystem::path& found, std::int64_t step)
{
  const auto all = checkpoints_in(found.parent_path());
  for (auto newer = all.upper_bound(step); newer != all.end(); ++newer) {
    std::filesystem::rename(newer->second, newer->second.string() + ".damaged");
  }
}

}  // namespace

CheckpointClock::CheckpointClock(const CheckpointPolicy& policy) : policy_(policy), simulated_(policy.simulated)
{
  simulated_.skip_to(0);
}

bool CheckpointClock::due(long step, double time)
{
  const bool by_time = simulated_.due(time);
  return by_time || (policy_.steps > 0 && step % policy_.steps == 0);
}

bool CheckpointClock::wall_time_over() const
{
  return std::chrono::duration<double>(Clock::now() - last_).count() > policy_.wall;
}

std::string fingerprint(const CheckedScene& scene)
{
  Json inputs = Json::object();
  for (const InputFile& input : scene.inputs) {
    if (!input.pointer.empty() && !input.hash.empty()) inputs[input.pointer] = input.hash;
  }
  return Json{{"scene", hash_of(json_text(essence(scene.resolved, scene.inputs)))}, {"inputs", inputs}}.dump();
}

std::optional<std::int64_t> newest_step(const std::filesystem::path& run_folder)
{
  const auto all = checkpoints_in(run_folder / "checkpoints");
  if (all.empty()) return std::nullopt;
  return all.rbegin()->first;
}

runtime::FoundCheckpoint checkpoint_to_restart(const std::filesystem::path& run_folder, const CheckedScene& scene,
                                               const runtime::Communicator& communicator)
{
  const std::filesystem::path folder = run_folder / "checkpoints";
  std::vector<std::string> refused;
  auto found = runtime::newest_checkpoint(folder, refused, communicator);
  if (communicator.is_first()) {
    for (const std::string& line : refused) print_err("tamp: refused a checkpoint: {}\n", line);
  }
  if (!found && !refused.empty()) {
    throw runtime::FileError(folder.string(), "none of its checkpoints can be read, for the reasons above");
  }
  if (!found) {
    throw InputError({folder.string(), "no whole checkpoint", "expected the folder of a run that has written one"});
  }
  expect_same_scene(*found, scene, run_folder);
  runtime::on_first_rank(communicator, [&] { set_aside_newer(found->file, found->header.step); });
  return *std::move(found);
}

}  // namespace tamp::tools
