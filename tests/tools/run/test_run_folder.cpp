#include <catch2/catch.hpp>
#include <chrono>
#include <memory>
#include <thread>

#include "runtime/file_error.hpp"
#include "runtime/storage/file_state.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/run/run_folder.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/system/errors.hpp"

namespace test_run_folder
{

using namespace tamp;
using test::TemporaryFolder;
using tools::RunFolder;

namespace
{

namespace fs = std::filesystem;

void use(const fs::path& folder, RunFolder::Use purpose, const std::vector<fs::path>& inputs = {})
{
  const RunFolder run(folder, purpose, inputs);
}

constexpr auto begin = RunFolder::Use::begin, replace = RunFolder::Use::replace, go_on = RunFolder::Use::go_on;

}  // namespace

TEST_CASE("a new folder for a run is made, with those above it, and marked")
{
  const TemporaryFolder folder;

  use(folder.path() / "runs/punch", begin);

  CHECK(fs::exists(folder.path() / "runs/punch/.tamp-run"));
}

TEST_CASE("a folder that holds anything is refused, and left as it was")
{
  const TemporaryFolder folder;
  folder.write("history.csv", "step\n");

  CHECK_THROWS_WITH(use(folder.path(), begin), Catch::Contains("the folder is not empty"));
  CHECK(fs::exists(folder.path() / "history.csv"));
  CHECK_FALSE(fs::exists(folder.path() / ".tamp-run"));
}

TEST_CASE("replacing a run removes what runs write and nothing else")
{
  const TemporaryFolder folder;
  use(folder.path(), begin);
  folder.write("history.csv", "step\n");
  folder.write("machine.csv", "step\n");
  folder.write("checkpoints/step_00000100.h5", "");
  folder.write("checkpoints/mymodel.pt", "mine");
  folder.write("notes.txt", "mine");

  use(folder.path(), replace);

  CHECK_FALSE(fs::exists(folder.path() / "history.csv"));
  CHECK_FALSE(fs::exists(folder.path() / "machine.csv"));
  CHECK_FALSE(fs::exists(folder.path() / "checkpoints/step_00000100.h5"));
  CHECK(test::read_text(folder.path() / "checkpoints/mymodel.pt") == "mine");
  CHECK(test::read_text(folder.path() / "notes.txt") == "mine");
}

TEST_CASE("a folder that no run has marked is not replaced, and left as it was")
{
  const TemporaryFolder folder;
  folder.write("profile.json", "mine");

  CHECK_THROWS_WITH(use(folder.path(), replace), Catch::Contains("no run has marked as its own"));
  CHECK(test::read_text(folder.path() / "profile.json") == "mine");
}

TEST_CASE("going on in a folder does not mark it, so that it is not replaced later")
{
  const TemporaryFolder folder;
  folder.write("profile.json", "mine");

  use(folder.path(), go_on);

  CHECK_THROWS_AS(use(folder.path(), replace), tools::InputError);
}

TEST_CASE("a folder in which lies what the run reads is not replaced")
{
  const TemporaryFolder folder;
  use(folder.path() / "run", begin);
  const fs::path scene = folder.write("run/scene.json", "{}"), table = folder.write("run/data/yield.csv", "1");

  CHECK_THROWS_WITH(use(folder.path() / "run", replace, {scene}), Catch::Contains("a folder with scene.json in it"));
  CHECK_THROWS_WITH(use(folder.path() / "run", replace, {table}), Catch::Contains("data/yield.csv"));
  CHECK(fs::exists(scene));
  use(folder.path() / "run", replace, {folder.write("run2/scene.json", "{}")});
}

TEST_CASE("a folder is free where another program has only just looked at its lock")
{
  const TemporaryFolder folder;
  folder.write(".run.lock.x7Ab2Q", "");

  use(folder.path(), begin);

  CHECK_THROWS_WITH(use(folder.write("other/.run.locks", "").parent_path(), begin), Catch::Contains("is not empty"));
}

TEST_CASE("a folder in use is refused, whatever it is wanted for", "[slow]")
{
  const auto purpose = GENERATE(begin, replace, go_on);
  const TemporaryFolder folder;
  const RunFolder first(folder.path(), begin, {});

  CHECK_THROWS_WITH(use(folder.path(), purpose), Catch::Contains("run.lock: in use by process"));
}

TEST_CASE("a restart waits a moment for a run that is about to end")
{
  const TemporaryFolder folder;
  auto first = std::make_unique<RunFolder>(folder.path(), begin, std::span<const fs::path>());
  std::thread end([&] {
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    first.reset();
  });

  CHECK_NOTHROW(use(folder.path(), go_on));

  end.join();
}

TEST_CASE("a file in the place of a run's folder is refused")
{
  const TemporaryFolder folder;

  CHECK_THROWS_AS(use(folder.write("run", ""), replace), tools::InputError);
}

TEST_CASE("a folder that cannot be made is an error of files")
{
  CHECK_THROWS_AS(use("/proc/no/such", begin), runtime::FileError);
}

TEST_CASE("a file of a run that is a link to what the run reads is refused, and what is read stays")
{
  const std::string name = GENERATE("history.csv", "fields.h5", "summary.json", "scene.json", ".tamp-run");
  const TemporaryFolder folder;
  const fs::path scene = folder.write("mine.json", "{}");
  tools::read_input_file(scene);
  use(folder.path() / "run", begin);
  fs::remove(folder.path() / "run" / name);
  fs::create_symlink("../mine.json", folder.path() / "run" / name);

  CHECK_THROWS_WITH(use(folder.path() / "run", go_on), Catch::Contains(name + ": one of the files that are read"));
  CHECK(test::read_text(scene) == "{}");
}

TEST_CASE("a file that gets the number of one that was read and removed is none that is read")
{
  const TemporaryFolder folder;
  const fs::path scene = folder.write("mine.json", "{}");
  tools::read_input_file(scene);
  REQUIRE(tools::is_input(scene));
  const auto number = runtime::state_of(scene)->number;
  fs::remove(scene);

  for (int n = 0; n < 100; ++n) {
    const fs::path other = folder.write("other_" + std::to_string(n), "");
    CHECK_FALSE(tools::is_input(other));
    if (runtime::state_of(other)->number == number) return;
  }
  WARN("no file got the number of the one that was removed");
}

TEST_CASE("a folder whose mark is a link to what the run reads is not marked")
{
  const TemporaryFolder folder;
  const fs::path scene = folder.write("mine.json", "{}");
  tools::read_input_file(scene);
  fs::create_directory(folder.path() / "run");
  fs::create_symlink("../mine.json", folder.path() / "run/.tamp-run");

  CHECK_THROWS_AS(use(folder.path() / "run", begin), tools::InputError);
  CHECK(test::read_text(scene) == "{}");
}

TEST_CASE("a run goes on from the scene that it wrote itself")
{
  const TemporaryFolder folder;
  use(folder.path(), begin);
  tools::read_input_file(folder.write("scene.json", "{}"));

  CHECK_NOTHROW(use(folder.path(), go_on));
}

TEST_CASE("room that is held for a file is there while the folder is, and no longer")
{
  const TemporaryFolder folder;
  const fs::path held = folder.path() / "summary.json.part";
  {
    RunFolder run(folder.path(), begin, {});
    run.hold_room_for("summary.json");
    CHECK(fs::file_size(held) >= 1 << 15);
  }

  CHECK_FALSE(fs::exists(held));
}

}  // namespace test_run_folder
