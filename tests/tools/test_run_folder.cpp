#include <unistd.h>

#include <catch2/catch.hpp>

#include "runtime/storage/file_error.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/errors.hpp"
#include "tools/run_folder.hpp"

using namespace tamp;
using test::TemporaryFolder;
using tools::prepare_run_folder;

TEST_CASE("a new folder for a run is made, with those above it")
{
  const TemporaryFolder folder;

  prepare_run_folder(folder.path() / "runs/punch", false);

  CHECK(std::filesystem::is_directory(folder.path() / "runs/punch"));
}

TEST_CASE("a folder that holds anything is refused, and left as it was")
{
  const TemporaryFolder folder;
  folder.write("history.csv", "step\n");

  CHECK_THROWS_AS(prepare_run_folder(folder.path(), false), tools::InputError);
  CHECK(std::filesystem::exists(folder.path() / "history.csv"));
}

TEST_CASE("force removes what a run writes and nothing else")
{
  const TemporaryFolder folder;
  folder.write("history.csv", "step\n");
  folder.write("checkpoints/1.h5", "");
  folder.write("notes.txt", "mine");

  prepare_run_folder(folder.path(), true);

  CHECK_FALSE(std::filesystem::exists(folder.path() / "history.csv"));
  CHECK_FALSE(std::filesystem::exists(folder.path() / "checkpoints"));
  CHECK(test::read_text(folder.path() / "notes.txt") == "mine");
}

TEST_CASE("a file in the place of a run's folder is refused")
{
  const TemporaryFolder folder;

  CHECK_THROWS_AS(prepare_run_folder(folder.write("run", ""), true), tools::InputError);
}

TEST_CASE("a folder that cannot be made is an error of files")
{
  CHECK_THROWS_AS(prepare_run_folder("/proc/no/such", false), runtime::FileError);
}
