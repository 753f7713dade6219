#include <array>
#include <catch2/catch.hpp>
#include <filesystem>

#include "runtime/storage/csv_writer.hpp"
#include "runtime/storage/file_error.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tests/runtime/storage/stored_data.hpp"
#include "tests/runtime/storage/temporary_folder.hpp"

using namespace tamp::runtime;
using namespace tamp::test;

namespace fs = std::filesystem;

TEST_CASE("a row is in the file as soon as it has been written, with numbers that read back the same")
{
  const TemporaryFolder folder;
  CsvWriter writer(folder.path / "history.csv", {"step", "time[s]"});

  writer.write_row(std::array{12.0, 0.1 + 0.2});

  CHECK(read_text(folder.path / "history.csv") == "step,time[s]\n12,0.30000000000000004\n");
}

TEST_CASE("a row with another number of values than there are columns is refused")
{
  const TemporaryFolder folder;
  CsvWriter writer(folder.path / "history.csv", {"step", "time[s]"});

  CHECK_THROWS_AS(writer.write_row(std::array{1.0}), std::invalid_argument);
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

TEST_CASE("a table goes on after the last step that is kept")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  write_text(file, "step,time[s]\n0,0\n10,0.1\n20,0.2\n30,0.3\n");

  CsvWriter::continued(file, {"step", "time[s]"}, 20).write_row(std::array{25.0, 0.25});

  CHECK(read_text(file) == "step,time[s]\n0,0\n10,0.1\n20,0.2\n25,0.25\n");
}

TEST_CASE("a row that was cut off by the end of a program is not kept")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  write_text(file, "step,time[s]\n0,0\n1");

  CsvWriter::continued(file, {"step", "time[s]"}, 20).write_row(std::array{5.0, 0.05});

  CHECK(read_text(file) == "step,time[s]\n0,0\n5,0.05\n");
}

TEST_CASE("a table that is missing or has not even its first row is begun anew where one is to go on")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  write_text(folder.path / "cut.csv", "step,ti");

  CsvWriter::continued(file, {"step", "time[s]"}, 20);
  CsvWriter::continued(folder.path / "cut.csv", {"step", "time[s]"}, 20);

  CHECK(read_text(file) == "step,time[s]\n");
  CHECK(read_text(folder.path / "cut.csv") == "step,time[s]\n");
}

TEST_CASE("a table of other columns is not gone on with, and is left as it was")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path / "history.csv";
  write_text(file, "step,depth[m]\n0,0\n");

  CHECK_THROWS_WITH(CsvWriter::continued(file, {"step", "time[s]"}, 20),
                    Catch::EndsWith("history.csv: has other columns than this run writes"));
  CHECK(read_text(file) == "step,depth[m]\n0,0\n");
}

TEST_CASE("a file written whole replaces the old one and leaves nothing beside it")
{
  const TemporaryFolder folder;
  write_whole_file(folder.path / "summary.json", "old and long");

  write_whole_file(folder.path / "summary.json", "new");

  CHECK(read_text(folder.path / "summary.json") == "new");
  CHECK(std::distance(fs::directory_iterator(folder.path), fs::directory_iterator()) == 1);
}

TEST_CASE("a file that cannot be replaced is an error, and is left as it was")
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path / "summary.json");

  CHECK_THROWS_AS(write_whole_file(folder.path / "summary.json", "new"), FileError);
  CHECK(fs::is_directory(folder.path / "summary.json"));
  CHECK_FALSE(fs::exists(folder.path / "summary.json.part"));
}
