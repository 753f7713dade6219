#include "tools/run/run_folder.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <regex>
#include <set>
#include <thread>
#include <vector>

#include "runtime/file_error.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

const std::vector<std::string>& written_by_run()
{
  static const std::vector<std::string> names{"scene.json", "history.csv", "machine.csv",  "summary.json",
                                              "fields.h5",  "fields.xdmf", "profile.json", "trace.json"};
  return names;
}

/// All that a run or a comparison writes into its folder. `.part` files are left by one that was killed while it wrote,
/// `.damaged` ones by one that found them so.
bool is_of_run(const fs::path& file)
{
  static const std::regex ending("(\\.part|\\.damaged(\\.[0-9]+)?)$");
  static const std::set<std::string> later{"page.json", "compare.csv", "compare.json", "report.html"};
  const std::string name = std::regex_replace(file.filename().string(), ending, "");
  return later.contains(name) || std::ranges::find(written_by_run(), name) != written_by_run().end();
}

bool is_checkpoint(const fs::path& file)
{
  static const std::regex name("step_[0-9]+\\.h5(\\.part|\\.damaged)?");
  return std::regex_match(file.filename().string(), name);
}

void remove_from(const fs::path& folder, bool (*is_to_go)(const fs::path&))
{
  std::vector<fs::path> found;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (is_to_go(entry.path())) found.push_back(entry.path());
  }
  for (const fs::path& file : found) fs::remove(file);
}

void remove_run(const fs::path& folder)
{
  remove_from(folder, is_of_run);
  const fs::path checkpoints = folder / "checkpoints";
  if (!fs::is_directory(checkpoints)) return;
  remove_from(checkpoints, is_checkpoint);
  if (fs::is_empty(checkpoints)) fs::remove(checkpoints);
}

/// Is nothing in the folder, but for a lock, what others make as they look at it, and the mark?
bool holds_nothing(const fs::path& folder)
{
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!runtime::FolderLock::makes(entry.path()) && entry.path().filename() != run_mark) return false;
  }
  return true;
}

void expect_free(const fs::path& folder, RunFolder::Use use)
{
  if (!fs::exists(folder) || use == RunFolder::Use::go_on || holds_nothing(folder)) return;
  if (use == RunFolder::Use::begin) {
    throw InputError({folder.string(), "the folder is not empty",
                      "expected an empty or new folder (--out), or --force to replace the run in it"});
  }
  if (!fs::exists(folder / run_mark)) {
    throw InputError({folder.string(), fmt::format("a folder that no run has marked as its own ({})", run_mark),
                      "expected one that a run has made; remove what is in this one yourself, or choose another"});
  }
}

void expect_no_input_in(const fs::path& folder, std::span<const fs::path> inputs)
{
  const fs::path own = fs::weakly_canonical(folder);
  for (const fs::path& input : inputs) {
    const fs::path below = fs::weakly_canonical(input).lexically_relative(own);
    if (below.empty() || *below.begin() == "..") continue;
    throw InputError({folder.string(), fmt::format("a folder with {} in it, which this run reads", below.string()),
                      "expected another folder (--out)"});
  }
}

/// A run may go on from the scene that it wrote itself.
bool is_own_scene(const fs::path& file)
{
  std::error_code none;
  return file.filename() == "scene.json" && fs::is_regular_file(fs::symlink_status(file, none));
}

void expect_own_files(const fs::path& folder)
{
  std::vector<std::string> names{run_mark};
  for (const std::string& name : written_by_run()) {
    if (!is_own_scene(folder / name)) names.push_back(name);
  }
  expect_results(folder, names);
}

/// Ranks whose launcher was killed end by themselves, but only in a second or so: a restart waits for them.
std::unique_ptr<runtime::FolderLock> lock_of(const fs::path& folder, RunFolder::Use use)
{
  constexpr std::chrono::milliseconds patience{3000}, pause{100};
  const auto begin = std::chrono::steady_clock::now();
  while (true) {
    try {
      return std::make_unique<runtime::FolderLock>(folder);
    } catch (const runtime::FolderInUse& in_use) {
      const bool may_wait = use == RunFolder::Use::go_on && std::chrono::steady_clock::now() - begin < patience;
      const fs::path lock = folder / runtime::FolderLock::file_name;
      if (!may_wait) throw InputError({lock.string(), in_use.what(), "expected a folder of its own for each run"});
    }
    std::this_thread::sleep_for(pause);
  }
}

}  // namespace

void note_files_of_run(const fs::path& folder)
{
  for (const std::string& name : written_by_run()) note_input(folder / name);
}

RunFolder::RunFolder(const fs::path& folder, Use use, std::span<const fs::path> inputs) : folder_(folder)
{
  try {
    if (fs::exists(folder) && !fs::is_directory(folder)) {
      throw InputError({folder.string(), "is a file", "expected a folder for the run, or a new name for one"});
    }
    if (use == Use::replace) expect_no_input_in(folder, inputs);
    // Whoever is at work there is the better reason; otherwise nothing is written where nothing may be.
    if (!fs::exists(folder / runtime::FolderLock::file_name)) expect_free(folder, use);
    if (use == Use::go_on && !fs::is_directory(folder)) {
      throw InputError({folder.string(), "no such folder", "expected the folder of a run"});
    }
    fs::create_directories(folder);
    if (access(folder.c_str(), W_OK | X_OK) != 0) throw runtime::FileError(folder.string(), "cannot be written to");
    lock_ = lock_of(folder, use);
    expect_free(folder, use);
    if (use == Use::replace) remove_run(folder);
    expect_own_files(folder);
    if (use != Use::go_on) {
      runtime::write_whole_file(folder / run_mark,
                                "Written by tamp. With --force, what a run writes is replaced here.\n");
    }
  } catch (const fs::filesystem_error& error) {
    throw runtime::FileError(folder.string(), error.code().message());
  }
  if (lock_->former_holder()) {
    notice_ = fmt::format("{}: the lock of a run that has ended was taken over: {}", folder.string(),
                          lock_->former_holder()->description());
  }
}

RunFolder::~RunFolder()
{
  if (!held_.empty() && lock_->is_own()) ::unlink(held_.c_str());
}

void RunFolder::hold_room_for(const std::string& name)
{
  constexpr std::int64_t n_bytes = 1 << 16;
  held_ = folder_ / (name + ".part");
  const int made = ::open(held_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0644);
  if (made < 0) return;
  static_cast<void>(posix_fallocate(made, 0, n_bytes));
  ::close(made);
}

void RunFolder::expect_own() const
{
  if (!lock_->is_own()) {
    throw runtime::FileError(folder_.string(), "was taken over by another program while this one was stopped");
  }
  for (const std::string& name : written_by_run()) runtime::expect_no_stream(folder_ / name);
}

}  // namespace tamp::tools
