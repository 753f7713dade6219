#include "tools/checkpointing.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "runtime/ranks/together.hpp"
#include "tools/errors.hpp"

namespace tamp::tools
{

namespace
{

/// FNV-1a, 64 bits.
std::uint64_t hash_of(const std::string& text)
{
  std::uint64_t hash = 0xcbf29ce484222325U;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3U;
  return hash;
}

/// Those that were refused are newer than the one that was found; under their names they would count as kept.
void set_aside_newer(const std::filesystem::path& found)
{
  std::vector<std::filesystem::path> newer;
  for (const auto& entry : std::filesystem::directory_iterator(found.parent_path())) {
    if (entry.path().extension() == ".h5" && entry.path() > found) newer.push_back(entry.path());
  }
  for (const auto& file : newer) std::filesystem::rename(file, file.string() + ".damaged");
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
  nlohmann::ordered_json essence = scene.resolved;
  essence.erase("title");
  essence.erase("output");
  if (essence.contains("time")) essence["time"].erase("end");
  return fmt::format("{:016x}", hash_of(essence.dump()));
}

runtime::FoundCheckpoint checkpoint_to_restart(const std::filesystem::path& run_folder, const CheckedScene& scene,
                                               const runtime::Communicator& communicator)
{
  const std::filesystem::path folder = run_folder / "checkpoints";
  std::vector<std::string> refused;
  auto found = runtime::newest_checkpoint(folder, refused, communicator);
  if (communicator.is_first()) {
    for (const std::string& line : refused) fmt::print(stderr, "tamp: refused a checkpoint: {}\n", line);
  }
  if (!found) {
    throw InputError({folder.string(), "no whole checkpoint", "expected the folder of a run that has written one"});
  }
  if (found->header.fingerprint != fingerprint(scene)) {
    throw InputError({found->file.string(), "a checkpoint of another scene",
                      "expected one of this scene, of which only the title, /time/end and /output may have changed"});
  }
  runtime::by_first(communicator, [&] { set_aside_newer(found->file); });
  return *std::move(found);
}

}  // namespace tamp::tools
