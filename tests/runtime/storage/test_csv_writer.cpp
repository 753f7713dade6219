#include <array>
#include <catch2/catch.hpp>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "runtime/storage/csv_writer.hpp"
#include "runtime/storage/file_error.hpp"
#include "runtime/storage/whole_file.hpp"

using namespace tamp::runtime;

namespace
{

namespace fs = std::filesystem;

fs::path new_folder()
{
  std::string name = (fs::temp_directory_path() / "tamp_csv_XXXXXX").string();
  return mkdtemp(name.data());
}

std::string read_text(const fs::path& file)
{
  std::ostringstream text;
  text << std::ifstream(file).rdbuf();
  return text.str();
}

}  // namespace

TEST_CASE("a row is in the file as soon as it has been written, with numbers that read back the same")
{
  const fs::path folder = new_folder();
  CsvWriter writer(folder / "history.csv", {"step", "time[s]"});

  writer.write_row(std::array{12.0, 0.1 + 0.2});

  CHECK(read_text(folder / "history.csv") == "step,time[s]\n12,0.30000000000000004\n");
  fs::remove_all(folder);
}

TEST_CASE("a row with another number of values than there are columns is refused")
{
  const fs::path folder = new_folder();
  CsvWriter writer(folder / "history.csv", {"step", "time[s]"});

  CHECK_THROWS_AS(writer.write_row(std::array{1.0}), std::invalid_argument);
  fs::remove_all(folder);
}

TEST_CASE("a full disk is an error that says so when a table is written")
{
  CHECK_THROWS_AS(CsvWriter("/dev/full", {"step"}), FileError);
  CHECK_THROWS_WITH(CsvWriter("/dev/full", {"step"}), "/dev/full: No space left on device");
}

TEST_CASE("a table in a folder that does not exist is an error that says so")
{
  CHECK_THROWS_WITH(CsvWriter("/no/such/history.csv", {"step"}), "/no/such/history.csv: No such file or directory");
}

TEST_CASE("a file written whole replaces the old one and leaves nothing beside it")
{
  const fs::path folder = new_folder();
  write_whole_file(folder / "summary.json", "old and long");

  write_whole_file(folder / "summary.json", "new");

  CHECK(read_text(folder / "summary.json") == "new");
  CHECK(std::distance(fs::directory_iterator(folder), fs::directory_iterator()) == 1);
  fs::remove_all(folder);
}

TEST_CASE("a file that cannot be replaced is an error, and is left as it was")
{
  const fs::path folder = new_folder();
  fs::create_directory(folder / "summary.json");

  CHECK_THROWS_AS(write_whole_file(folder / "summary.json", "new"), FileError);
  CHECK(fs::is_directory(folder / "summary.json"));
  CHECK_FALSE(fs::exists(folder / "summary.json.part"));
  fs::remove_all(folder);
}
