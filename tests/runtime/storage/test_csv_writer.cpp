#include <sys/stat.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>
#include <thread>

#include "runtime/file_error.hpp"
#include "runtime/storage/csv_writer.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_csv_writer
{

using namespace tamp::runtime;
using namespace tamp::test;

namespace fs = std::filesystem;

TEST_CASE("a row is in the file as soon as it has been written, with numbers that read back the same")
{
  const TemporaryFolder folder;
  CsvWriter writer(folder.path() / "history.csv", {"step", "time[s]"});

  writer.write_row(std::array{12.0, 0.1 + 0.2});

  CHECK(read_text(folder.path() / "history.csv") == "step,time[s]\n12,0.30000000000000004\n");
}

TEST_CASE("a row with another number of values than there are columns is refused")
{
  const TemporaryFolder folder;
  CsvWriter writer(folder.path() / "history.csv", {"step", "time[s]"});

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

namespace
{

const std::vector<std::string> step_and_time{"step", "time[s]"};

/// A table with a row for each step, and what of it there is up to and with step 20.
CsvExtent written(const fs::path& file, const std::vector<double>& steps)
{
  CsvWriter table(file, step_and_time);
  CsvExtent until_20 = table.extent();
  for (const double step : steps) {
    table.write_row(std::array{step, step / 100});
    if (step <= 20) until_20 = table.extent();
  }
  return until_20;
}

}  // namespace

TEST_CASE("a table goes on after the last step that is kept")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "history.csv";
  const CsvExtent until_20 = written(file, {0, 10, 20, 30});

  CsvWriter table = CsvWriter::continued(file, step_and_time, 20, until_20);
  table.write_row(std::array{25.0, 0.25});

  CHECK(table.notice().empty());
  CHECK(table.extent().n_rows == 4);
  CHECK(read_text(file) == "step,time[s]\n0,0\n10,0.1\n20,0.2\n25,0.25\n");
  CHECK_FALSE(fs::exists(folder.path() / "history.csv.damaged"));
}

TEST_CASE("a row that was cut off by the end of a program is not kept")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "history.csv";
  const CsvExtent until_20 = written(file, {0});
  write_text(file, "step,time[s]\n0,0\n1");

  CsvWriter table = CsvWriter::continued(file, step_and_time, 20, until_20);
  table.write_row(std::array{5.0, 0.05});

  CHECK(table.notice().empty());
  CHECK(read_text(file) == "step,time[s]\n0,0\n5,0.05\n");
}

TEST_CASE("a table that is missing is begun anew where one is to go on, and told of")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "history.csv";

  const CsvWriter table = CsvWriter::continued(file, step_and_time, 20, {3, 1});

  CHECK_THAT(table.notice(), Catch::EndsWith("is missing, with the 3 rows until step 20; it was begun anew"));
  CHECK(read_text(file) == "step,time[s]\n");
}

TEST_CASE("a table that nobody has counted goes on with what can be read of it, and without a word")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "machine.csv";
  const auto [text, kept] =
      GENERATE(std::pair{"step,time[s]\n0,0\n10,0.x\n20,0.2\n30,0.3\n", "step,time[s]\n0,0\n20,0.2\n"},
               std::pair{"", "step,time[s]\n"});
  write_text(file, text);

  const CsvWriter table = CsvWriter::continued(file, step_and_time, 20);

  CHECK(table.notice().empty());
  CHECK(read_text(file) == kept);
  CHECK_FALSE(fs::exists(folder.path() / "machine.csv.damaged"));
}

TEST_CASE("of a damaged table the rows that can be read are kept, the file is set aside, and both are reported")
{
  struct Damage {
    std::string text;
    std::string kept;
  };
  const std::string header = "step,time[s]\n";
  const Damage damage = GENERATE_COPY(Damage{header + "0,0\n20,0.2\n", "0,0\n20,0.2\n"},          // a row is gone
                                      Damage{header + "0,0\n10,0.x\n20,0.2\n", "0,0\n20,0.2\n"},  // no number
                                      Damage{header + "0,0\n10,0.1,0.2\n", "0,0\n"},              // two lines in one
                                      Damage{header + "0,0\n10,0.7\n20,0.2\n", "0,0\n10,0.7\n20,0.2\n"},
                                      Damage{"step,ti", ""}, Damage{"", ""}, Damage{"step,depth[m]\n0,0\n", ""});
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "history.csv";
  const CsvExtent until_20 = written(file, {0, 10, 20});
  write_text(file, damage.text);

  const CsvWriter table = CsvWriter::continued(file, step_and_time, 20, until_20);

  CHECK_THAT(table.notice(),
             Catch::Contains("is damaged: of 3 rows until step 20") && Catch::EndsWith("history.csv.damaged"));
  CHECK(read_text(file) == header + damage.kept);
  CHECK(read_text(folder.path() / "history.csv.damaged") == damage.text);
}

TEST_CASE("a table that was removed, replaced or emptied while it was written is told of, and one that was not is not")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "history.csv";
  CsvWriter table(file, step_and_time);
  const auto write = [&](double step) { table.write_row(std::array{step, 0.5}); };
  write(0);
  write(10);
  CHECK_NOTHROW(table.expect_as_written());

  SECTION("removed")
  {
    fs::remove(file);
    write(20);
    CHECK_THROWS_WITH(table.expect_as_written(), Catch::Contains("history.csv: was removed"));
  }
  SECTION("replaced by a copy")
  {
    fs::copy_file(file, folder.path() / "copy.csv");
    fs::rename(folder.path() / "copy.csv", file);
    CHECK_THROWS_WITH(table.expect_as_written(), Catch::Contains("history.csv: was replaced"));
  }
  SECTION("emptied: the rows after it follow without a gap")
  {
    fs::resize_file(file, 0);
    write(20);
    CHECK_THROWS_WITH(table.expect_as_written(), Catch::Contains("it has 7 bytes of 33"));
    CHECK(read_text(file) == "20,0.5\n");
  }
}

TEST_CASE("a pipe in the place of a table or of a part of a file is refused unopened")
{
  const TemporaryFolder folder;
  const fs::path table = folder.path() / "history.csv", part = folder.path() / "summary.json.part";
  REQUIRE(mkfifo(table.c_str(), 0600) == 0);
  REQUIRE(mkfifo(part.c_str(), 0600) == 0);

  CHECK_THROWS_WITH(CsvWriter::continued(table, step_and_time, 20),
                    Catch::EndsWith("history.csv: a pipe, a device or a socket; expected a file"));
  CHECK_THROWS_WITH(write_whole_file(folder.path() / "summary.json", "new"),
                    Catch::EndsWith("summary.json.part: a pipe, a device or a socket; expected a file"));
  CHECK(fs::is_fifo(table));
}

TEST_CASE("what lies under the name of a part is not written into")
{
  const TemporaryFolder folder;
  write_text(folder.path() / "mine", "mine");
  fs::create_symlink("mine", folder.path() / "a.json.part");
  fs::create_hard_link(folder.path() / "mine", folder.path() / "b.json.part");

  write_whole_file(folder.path() / "a.json", "new");
  write_whole_file(folder.path() / "b.json", "new");

  CHECK(read_text(folder.path() / "mine") == "mine");
  CHECK(read_text(folder.path() / "b.json") == "new");
}

TEST_CASE("a file written whole replaces the old one and leaves nothing beside it")
{
  const TemporaryFolder folder;
  write_whole_file(folder.path() / "summary.json", "old and long");

  write_whole_file(folder.path() / "summary.json", "new");

  CHECK(read_text(folder.path() / "summary.json") == "new");
  CHECK(std::distance(fs::directory_iterator(folder.path()), fs::directory_iterator()) == 1);
}

TEST_CASE("a link stays a link, and the file it points to is written whole")
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "elsewhere");
  write_text(folder.path() / "elsewhere" / "summary.json", "old");
  fs::create_symlink("elsewhere/summary.json", folder.path() / "summary.json");
  fs::create_symlink("summary.json", folder.path() / "latest.json");

  write_whole_file(folder.path() / "latest.json", "new");

  CHECK(fs::is_symlink(folder.path() / "latest.json"));
  CHECK(fs::is_symlink(folder.path() / "summary.json"));
  CHECK(read_text(folder.path() / "elsewhere" / "summary.json") == "new");
}

TEST_CASE("a pipe is written to, and stays one")
{
  const TemporaryFolder folder;
  const fs::path pipe = folder.path() / "pipe";
  REQUIRE(mkfifo(pipe.c_str(), 0600) == 0);
  std::string found;
  std::thread reader([&] { found = read_text(pipe); });

  write_whole_file(pipe, "told");
  reader.join();

  CHECK(found == "told");
  CHECK(fs::is_fifo(pipe));
  CHECK_THROWS_AS(write_whole_file("/dev/full", "told"), FileError);
  CHECK(fs::is_character_file("/dev/full"));
}

TEST_CASE("what was not published leaves nothing")
{
  const TemporaryFolder folder;
  {
    WholeFile file(folder.path() / "trace.json");
    file.write("half of");
  }

  CHECK(fs::is_empty(folder.path()));
}

TEST_CASE("a file that cannot be replaced is an error, and is left as it was")
{
  const TemporaryFolder folder;
  fs::create_directory(folder.path() / "summary.json");

  CHECK_THROWS_AS(write_whole_file(folder.path() / "summary.json", "new"), FileError);
  CHECK(fs::is_directory(folder.path() / "summary.json"));
  CHECK_FALSE(fs::exists(folder.path() / "summary.json.part"));
}

}  // namespace test_csv_writer
