#include "tools/run_folder.hpp"

#include <unistd.h>

#include <array>

#include "runtime/storage/file_error.hpp"
#include "tools/errors.hpp"

namespace tamp::tools
{

namespace
{

namespace fs = std::filesystem;

/// All that a run writes into its folder; `.part` files are left by one that was killed while it wrote.
constexpr std::array written_by_a_run{"scene.json",   "history.csv",       "summary.json",      "fields.h5",
                                      "fields.xdmf",  "fields.xdmf.part",  "summary.json.part", "scene.json.part",
                                      "profile.json", "profile.json.part", "trace.json",        "trace.json.part",
                                      "checkpoints"};

void prepare(const fs::path& folder, bool force)
{
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw InputError({folder.string(), "is a file", "expected a folder for the run, or a new name for one"});
  }
  if (fs::exists(folder) && !fs::is_empty(folder)) {
    if (!force) {
      throw InputError({folder.string(), "the folder is not empty",
                        "expected an empty or new folder (--out), or --force to replace the run in it"});
    }
    for (const char* name : written_by_a_run) fs::remove_all(folder / name);
  }
  fs::create_directories(folder);
}

}  // namespace

void prepare_run_folder(const std::filesystem::path& folder, bool force)
{
  try {
    prepare(folder, force);
  } catch (const fs::filesystem_error& error) {
    throw runtime::FileError(folder.string(), error.code().message());
  }
  if (access(folder.c_str(), W_OK | X_OK) != 0) throw runtime::FileError(folder.string(), "cannot be written to");
}

}  // namespace tamp::tools
