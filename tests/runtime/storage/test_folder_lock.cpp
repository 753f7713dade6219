#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>

#include "runtime/file_error.hpp"
#include "runtime/storage/folder_lock.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_folder_lock
{

using namespace tamp::runtime;
using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

void let_it_be_old(const fs::path& file, std::chrono::seconds age)
{
  fs::last_write_time(file, fs::file_time_type::clock::now() - age);
}

std::string own_host()
{
  std::array<char, 256> name{};
  gethostname(name.data(), name.size() - 1);
  return name.data();
}

/// The number of a process that has ended.
pid_t ended_process()
{
  const pid_t child = fork();
  if (child == 0) _exit(0);
  waitpid(child, nullptr, 0);
  return child;
}

}  // namespace

TEST_CASE("a folder has one lock at a time, which says whose it is, and is gone with its holder")
{
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    CHECK_FALSE(lock.former_holder());
    CHECK(lock.is_own());
    CHECK_THAT(read_text(folder.path() / "run.lock"),
               Catch::Contains("host " + own_host()) && Catch::Contains("process " + std::to_string(getpid())));
    CHECK_THROWS_WITH(FolderLock(folder.path()), Catch::Contains("in use by process " + std::to_string(getpid())));
  }
  CHECK_FALSE(fs::exists(folder.path() / "run.lock"));
}

TEST_CASE("the lock of a process of this machine that has ended is taken over at once")
{
  const TemporaryFolder folder;
  const pid_t ended = ended_process();
  write_text(folder.path() / "run.lock",
             "host " + own_host() + "\nprocess " + std::to_string(ended) + "\nsince then\n");

  const FolderLock lock(folder.path());

  REQUIRE(lock.former_holder());
  CHECK(lock.former_holder()->process == ended);
  CHECK(lock.former_holder()->since == "then");
}

TEST_CASE("the lock of another machine is taken over when it has not been touched for a minute")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "run.lock";
  write_text(file, "host elsewhere\nprocess 12\nsince then\n");

  let_it_be_old(file, std::chrono::seconds(30));
  CHECK_THROWS_AS(FolderLock(folder.path()), FolderInUse);
  let_it_be_old(file, std::chrono::seconds(70));
  const FolderLock lock(folder.path());

  CHECK(lock.former_holder()->host == "elsewhere");
}

TEST_CASE("a lock that is dated far ahead, by whatever clock, is taken over and told of")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "run.lock";
  write_text(file, "host elsewhere\nprocess 12\nsince then\n");

  let_it_be_old(file, std::chrono::seconds(-30));
  CHECK_THROWS_WITH(FolderLock(folder.path()), Catch::Contains("last heard of 0 s ago"));
  let_it_be_old(file, std::chrono::hours(-24));
  const FolderLock lock(folder.path());

  CHECK_THAT(lock.former_holder()->description(),
             Catch::Contains("its lock dated 86") && Catch::Contains("s ahead of now"));
}

TEST_CASE("a pipe, a folder or a link under a lock's name is refused and left alone")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "run.lock";
  const int kind = GENERATE(0, 1, 2);
  if (kind == 0) REQUIRE(mkfifo(file.c_str(), 0600) == 0);
  if (kind == 1) fs::create_directory(file);
  if (kind == 2) fs::create_symlink("nowhere", file);

  CHECK_THROWS_WITH(FolderLock(folder.path()), Catch::Contains("run.lock: is no file"));
  CHECK(fs::exists(fs::symlink_status(file)));
}

TEST_CASE("a lock that another program has replaced is no longer its own, and stays when its holder ends")
{
  const TemporaryFolder folder;
  {
    const FolderLock lock(folder.path());
    fs::remove(folder.path() / "run.lock");
    write_text(folder.path() / "run.lock", "host elsewhere\n");
    CHECK_FALSE(lock.is_own());
  }
  CHECK(read_text(folder.path() / "run.lock") == "host elsewhere\n");
}

TEST_CASE("a lock that was not written to its end counts as one")
{
  const TemporaryFolder folder;
  write_text(folder.path() / "run.lock", "");

  CHECK_THROWS_WITH(FolderLock(folder.path()), Catch::Contains("on an unknown machine since an unknown time"));
}

TEST_CASE("a folder that cannot be locked is an error of files")
{
  CHECK_THROWS_AS(FolderLock("/no/such/folder"), FileError);
  CHECK_THROWS_AS(FolderLock("/proc"), FileError);
}

}  // namespace test_folder_lock
