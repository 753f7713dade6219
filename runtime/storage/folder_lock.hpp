#pragma once

#include <condition_variable>
#include <filesystem>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

namespace tamp::runtime
{

/// The program that holds a folder, as its lock file tells.
struct LockHolder {
  std::string host;
  long process = 0;
  /// When it took the folder, UTC, such as 2026-11-22T16:40:00Z.
  std::string since;
  /// Seconds since it last touched its lock; below 0 for a lock that is dated ahead of the folder's clock.
  double untouched = 0;

  /// Whether `untouched` is a minute at least, either way: a program that is alive touches its lock every ten seconds.
  bool is_silent() const;
  /// The holder in words, such as "process 12 on HOST since TIME, last heard of 3 s ago".
  std::string description() const;
};

/// The folder is another program's.
struct FolderInUse : std::runtime_error {
  explicit FolderInUse(const LockHolder& holder) : std::runtime_error("in use by " + holder.description()) {}
};

/// Keeps a folder for one program, by the file `run.lock` in it, which is touched every ten seconds. The lock of a
/// program that has gone, on this machine, or has not touched it for a minute, on any, is taken over; so is one that is
/// dated a minute ahead, by a clock that was wrong. A program that
/// was stopped for so long and goes on finds that it is no longer its own.
class FolderLock
{
 public:
  static constexpr const char* file_name = "run.lock";

  /// Whether a file of the folder is the lock, or one that a program makes there for a moment to read the disk's clock.
  static bool makes(const std::filesystem::path& file);

  /// Throws FolderInUse, and FileError if the file cannot be written, something else has its name, or the thread that
  /// touches it cannot be started.
  explicit FolderLock(const std::filesystem::path& folder);
  /// Removes the file, if it is still this program's.
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

  /// The program whose lock was taken over.
  const std::optional<LockHolder>& former_holder() const { return former_; }
  /// Whether no other program has taken the folder over; to be asked before something is written into it.
  bool is_own() const;

 private:
  void take();
  void touch_until_stopped();

  std::filesystem::path folder_;
  std::filesystem::path file_;
  /// Held open with an flock of its own, which ends with the process in whatever way that ends.
  int descriptor_ = -1;
  std::optional<LockHolder> former_;
  std::mutex mutex_;
  std::condition_variable stop_;
  bool stopped_ = false;
  std::thread toucher_;
};

}  // namespace tamp::runtime
