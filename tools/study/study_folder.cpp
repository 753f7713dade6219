#include "tools/study/study_folder.hpp"

#include <fmt/format.h>

#include <fstream>

#include "runtime/file_error.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/json/document.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/machine.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::study
{

namespace
{

namespace fs = std::filesystem;

constexpr const char* study_mark = ".tamp-study";

/// This program, by its content. With a sanitizer and debug information it is larger than any input may be.
std::string program_hash()
{
  static const std::string hash = [] {
    const fs::path program = "/proc/self/exe";
    std::string content(fs::file_size(program), '\0');
    std::ifstream(program, std::ios::binary).read(content.data(), static_cast<std::streamsize>(content.size()));
    return hash_of(content);
  }();
  return hash;
}

/// First line of a mark; empty if it is no file.
std::string content_of(const fs::path& mark)
{
  if (!fs::is_regular_file(mark)) return "";
  const std::string text = read_input_file(mark);
  return text.substr(0, text.find('\n'));
}

/// A mark may hold anything.
std::string mark_text(const std::string& content)
{
  constexpr std::size_t most = 300;
  return content.empty() ? "its mark is empty or no file" : utf8(content.substr(0, most));
}

bool holds_no_file(const fs::path& folder)
{
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (!runtime::FolderLock::makes(entry.path())) return false;
  }
  return true;
}

void expect_study(const fs::path& folder)
{
  if (!fs::exists(folder)) return;
  if (!fs::is_directory(folder)) {
    throw InputError({folder.string(), "is a file", "expected a folder for the study, or a new name for one"});
  }
  if (fs::exists(folder / study_mark) || holds_no_file(folder)) return;
  throw InputError({folder.string(), fmt::format("a folder that no study has marked as its own ({})", study_mark),
                    "expected an empty or new folder (--out), or that of an earlier run of a study"});
}

}  // namespace

StudyFolder::StudyFolder(const fs::path& folder, bool force) : folder_(folder)
{
  try {
    expect_study(folder);
    fs::create_directories(folder);
    try {
      lock_ = std::make_unique<runtime::FolderLock>(folder);
    } catch (const runtime::FolderInUse& in_use) {
      throw InputError({folder.string(), in_use.what(), "expected a folder of its own for each study"});
    }
    expect_own_program(force);
    if (!fs::is_directory(points())) fs::remove(points());
    fs::create_directories(points());
  } catch (const fs::filesystem_error& error) {
    throw runtime::FileError(folder.string(), error.code().message());
  }
}

void StudyFolder::expect_own_program(bool force) const
{
  const std::string own =
      Json{{"program", program_hash()}, {"version", version()}, {"processor", machine_json()["processor"]}}.dump();
  const fs::path mark = folder_ / study_mark;
  if (fs::exists(mark) && content_of(mark) != own) {
    if (!force) {
      throw InputError(
          {folder_.string(), "results of another program or processor: " + mark_text(content_of(mark)),
           fmt::format("expected results of this one, {}; --force removes them, --out names another folder", own)});
    }
    fs::remove_all(points());
  }
  runtime::write_whole_file(mark, own + "\n");
}

}  // namespace tamp::tools::study
