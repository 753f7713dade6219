#pragma once

#include <filesystem>
#include <memory>
#include <span>
#include <string>

#include "runtime/storage/folder_lock.hpp"

namespace tamp::tools
{

/// The file that marks a folder as a run's.
inline constexpr const char* run_mark = ".tamp-run";

/// Notes what a run has left as inputs, for those who draw from it.
void note_files_of_run(const std::filesystem::path& folder);

/// A run's folder, which is that run's alone while this lives. The first run in it marks it with the file `.tamp-run`;
/// only what is marked is ever replaced, and of that only files that a run or a comparison writes.
class RunFolder
{
 public:
  enum class Use {
    /// Nothing may be in it, or it is not there.
    begin,
    /// Nothing, or an earlier run, which is removed.
    replace,
    /// Existing files stay. Who is still at work there has three seconds to end.
    go_on,
  };

  /// Makes the folder and all above it. Throws InputError for a folder that is in use by another program, that may not
  /// be used in this way, that would be replaced although one of `inputs`, the files that the run reads, is in it, or
  /// in which a file of the run is a link to one of them; FileError for one that cannot be made, emptied or written to,
  /// or with a pipe, a device or a socket in the place of a file.
  RunFolder(const std::filesystem::path& folder, Use use, std::span<const std::filesystem::path> inputs);
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  /// Takes the room that a small file needs, such as a summary, for when the disk will be full: it is given back as
  /// that file is written, see runtime::WholeFile. Nothing where there is no such room.
  void hold_room_for(const std::string& name);

  /// A notice for the user; may be empty.
  const std::string& notice() const { return notice_; }
  /// Throws FileError if another program has taken the folder over, while this one was stopped, and for a pipe that now
  /// stands where a file of the run should be: to open it might take for ever.
  void expect_own() const;

 private:
  std::filesystem::path folder_;
  std::unique_ptr<runtime::FolderLock> lock_;
  std::string notice_;
  /// Empty: none.
  std::filesystem::path held_;
};

}  // namespace tamp::tools
