#pragma once

#include <filesystem>
#include <memory>

#include "runtime/storage/folder_lock.hpp"

namespace tamp::tools::study
{

/// A study's folder, which is one program's alone while this lives: what it has found, in `points` a folder for each
/// result, and the mark `.tamp-study`, which says what program made them on which processor. Results of another program
/// are no results of this one, and times of another processor none of this one.
class StudyFolder
{
 public:
  /// Makes the folder, or goes on with what is in it. Throws InputError for a folder that is in use, that is not empty
  /// and no study's, or that another program has filled, unless `force` lets its results be removed; FileError for one
  /// that cannot be made or written to.
  StudyFolder(const std::filesystem::path& folder, bool force);

  std::filesystem::path points() const { return folder_ / "points"; }

 private:
  void expect_own_program(bool force) const;

  std::filesystem::path folder_;
  std::unique_ptr<runtime::FolderLock> lock_;
};

}  // namespace tamp::tools::study
