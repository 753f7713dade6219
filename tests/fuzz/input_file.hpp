#pragma once

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

#include "runtime/file_error.hpp"
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
    std::string name = (std::filesystem::temp_directory_path() / "tamp_fuzz_XXXXXX").string();
    folder_ = mkdtemp(name.data());
    std::filesystem::create_directory_symlink(TAMP_SOURCE_DIR "/inputs", folder_ / "inputs");
    std::filesystem::create_directory_symlink(TAMP_SOURCE_DIR "/tests/fuzz/corpus", folder_ / "corpus");
  }
  ~InputFile() { std::filesystem::remove_all(folder_); }
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;

  /// Without an ending, so that the content tells what it is.
  std::filesystem::path path() const { return folder_ / "input"; }

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
  std::filesystem::path folder_;
};

}  // namespace tamp::fuzz
