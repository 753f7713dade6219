#pragma once

#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/file_error.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tools/system/errors.hpp"

namespace tamp::fuzz
{

/// A folder of this process with one file, over which each input is written: the program remembers every file that it
/// has read, and of this one once. Beside it `inputs` leads to the shipped ones, and `corpus` to small ones.
class InputFile
{
 public:
  InputFile()
  {
    std::filesystem::create_directory_symlink(TAMP_SOURCE_DIR "/inputs", folder_.path() / "inputs");
    std::filesystem::create_directory_symlink(TAMP_SOURCE_DIR "/tests/fuzz/corpus", folder_.path() / "corpus");
  }

  /// Without an ending, so that the content tells what it is.
  std::filesystem::path path() const { return folder_.path() / "input"; }

  /// Gives the bytes to a reader. What it throws but for its two sound answers is let through.
  void read_by(void (*reader)(const std::filesystem::path&), const char* bytes, std::size_t n_bytes) const
  {
    std::ofstream(path(), std::ios::binary).write(bytes, static_cast<std::streamsize>(n_bytes));
    try {
      reader(path());
    } catch (const tools::InputError&) {
    } catch (const runtime::FileError&) {
    }
  }

 private:
  runtime::TemporaryFolder folder_;
};

}  // namespace tamp::fuzz
