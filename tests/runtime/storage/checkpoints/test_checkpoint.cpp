#include "runtime/storage/checkpoints/checkpoint.hpp"

#include <catch2/catch.hpp>

#include "runtime/file_error.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/storage/checkpoints/state_scene.hpp"
#include "tests/runtime/storage/file_size_limit.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_checkpoint
{

using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

std::vector<std::byte> as_bytes(const std::string& text)
{
  const auto* const first = reinterpret_cast<const std::byte*>(text.data());
  return {first, first + text.size()};
}

/// Writes a checkpoint of a scene that is filled by `variant`.
void write(const fs::path& folder, std::int64_t step, int variant, int keep = 2, const Communicator& communicator = {})
{
  StateScene scene(communicator);
  scene.fill(variant);
  write_checkpoint(folder, {step, 0.1 * static_cast<double>(step), "scene"}, as_bytes("host"), scene.warehouse, groups,
                   keep, communicator);
}

std::string filled(int variant, const Communicator& communicator = {}, int shift = 0)
{
  StateScene scene(communicator, shift);
  scene.fill(variant);
  return scene.bytes();
}

std::string resumed(const FoundCheckpoint& found, const Communicator& communicator = {}, int shift = 0)
{
  StateScene scene(communicator, shift);
  read_checkpoint(found, scene.warehouse, groups, communicator);
  return scene.bytes();
}

std::vector<std::string> names_in(const fs::path& folder)
{
  std::vector<std::string> names;
  for (const fs::directory_entry& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename());
  std::sort(names.begin(), names.end());
  return names;
}

}  // namespace

TEST_CASE("a checkpoint brings every bit of the state back, of numbers that are none too")
{
  const TemporaryFolder folder;
  std::vector<std::string> refused;

  write(folder.path(), 12, 1);
  const auto found = newest_checkpoint(folder.path(), refused);

  REQUIRE(found);
  CHECK(resumed(*found) == filled(1));
  CHECK(filled(1) != filled(2));
  CHECK(refused.empty());
}

TEST_CASE("a checkpoint brings back its header and the bytes of the host")
{
  const TemporaryFolder folder;
  StateScene scene;
  std::vector<std::string> refused;
  const std::vector<std::byte> host = as_bytes(std::string("seed\0 and \xff", 11));

  write_checkpoint(folder.path(), {12, 0.1 + 0.2, "punch 4f2a"}, host, scene.warehouse, groups, 1);
  const auto found = newest_checkpoint(folder.path(), refused);

  REQUIRE(found);
  CHECK(found->file == folder.path() / "step_00000012.h5");
  CHECK(found->header.step == 12);
  CHECK(found->header.time == 0.1 + 0.2);
  CHECK(found->header.fingerprint == "punch 4f2a");
  CHECK(found->host == host);
}

TEST_CASE("a checkpoint of a host without bytes of its own and a state without particles is whole")
{
  const TemporaryFolder folder;
  StateScene scene;
  std::vector<std::string> refused;

  write_checkpoint(folder.path(), {0, 0, ""}, {}, scene.warehouse, groups, 1);
  const auto found = newest_checkpoint(folder.path(), refused);

  REQUIRE(found);
  CHECK(found->host.empty());
  CHECK(resumed(*found) == StateScene().bytes());
}

TEST_CASE("resuming from a checkpoint leaves no more particles than it has")
{
  const TemporaryFolder folder;
  write(folder.path(), 1, 0);
  StateScene scene;
  for (const Patch& patch : scene.layout) scene.warehouse.set_n_particles(patch.id, 0, 50);
  std::vector<std::string> refused;

  read_checkpoint(newest_checkpoint(folder.path(), refused).value(), scene.warehouse, groups);

  CHECK(scene.bytes() == filled(0));
}

TEST_CASE("rows of a checkpoint stand in the order of the patches")
{
  const TemporaryFolder folder;

  write(folder.path(), 1, 0);

  const Dataset numbers = read_dataset(folder.path() / "step_00000001.h5", "particles/sand/number");
  const Dataset by_patch = read_dataset(folder.path() / "step_00000001.h5", "by_patch/particles/sand/number");
  CHECK(numbers.dimensions == std::vector<hsize_t>{6, 1});
  CHECK(numbers.values == std::vector<double>{100, 200, 201, 300, 301, 302});
  CHECK(by_patch.dimensions == std::vector<hsize_t>{4, 2});
  CHECK(by_patch.values[0] == 0);
  CHECK(by_patch.values[2] == 1);
  CHECK(by_patch.values[4] == 2);
  CHECK(by_patch.values[6] == 3);
}

TEST_CASE("only the newest checkpoints are kept")
{
  const TemporaryFolder folder;

  for (const int step : {5, 10, 15, 20}) write(folder.path(), step, step, 2);

  CHECK(names_in(folder.path()) == std::vector<std::string>{"step_00000015.h5", "step_00000020.h5"});
}

TEST_CASE("a checkpoint before one that is there already takes its place")
{
  const TemporaryFolder folder;
  write(folder.path(), 10, 1);
  write(folder.path(), 30, 2);
  std::vector<std::string> refused;

  write(folder.path(), 20, 3);

  CHECK(names_in(folder.path()) == std::vector<std::string>{"step_00000010.h5", "step_00000020.h5"});
  CHECK(resumed(newest_checkpoint(folder.path(), refused).value()) == filled(3));
}

TEST_CASE("a checkpoint that was begun is no checkpoint, and is gone after the next")
{
  const TemporaryFolder folder;
  write(folder.path(), 10, 1);
  fs::copy_file(folder.path() / "step_00000010.h5", folder.path() / "step_00000020.h5.part");
  std::vector<std::string> refused;

  const auto found = newest_checkpoint(folder.path(), refused);
  write(folder.path(), 15, 2);

  CHECK(found.value().header.step == 10);
  CHECK(refused.empty());
  CHECK(names_in(folder.path()) == std::vector<std::string>{"step_00000010.h5", "step_00000015.h5"});
}

TEST_CASE("in a folder that is empty or does not exist there is no checkpoint")
{
  const TemporaryFolder folder;
  std::vector<std::string> refused;

  CHECK_FALSE(newest_checkpoint(folder.path(), refused));
  CHECK_FALSE(newest_checkpoint(folder.path() / "none", refused));
  CHECK(refused.empty());
}

TEST_CASE("a checkpoint for which there is no room is an error, and the one before stays")
{
  const TemporaryFolder folder;
  write(folder.path(), 10, 1);
  std::vector<std::string> refused;

  std::string message;
  {
    const FileSizeLimit limit(20000);
    try {
      write(folder.path(), 20, 2, 1);
    } catch (const FileError& error) {
      message = error.what();
    }
  }

  CHECK_THAT(message, Catch::Contains("step_00000020.h5") && Catch::Contains("File too large"));
  CHECK(names_in(folder.path()) == std::vector<std::string>{"step_00000010.h5"});
  CHECK(resumed(newest_checkpoint(folder.path(), refused).value()) == filled(1));
}

TEST_CASE("a checkpoint of other patches, groups or labels is refused with what it is of")
{
  const TemporaryFolder folder;
  write(folder.path(), 1, 0);
  std::vector<std::string> refused;
  const FoundCheckpoint found = newest_checkpoint(folder.path(), refused).value();
  StateScene scene, four_in_a_row({}, 0, {4, 1, 1}),
      colourless({}, 0, {2, 2, 1}, {&place, &number, &warmth, &drift, &age, &season, &rain});

  CHECK_THROWS_WITH(read_checkpoint(found, four_in_a_row.warehouse, groups),
                    Catch::Contains("is of another scene: patches 2 x 2 x 1, expected 4 x 1 x 1"));
  CHECK_THROWS_WITH(read_checkpoint(found, scene.warehouse, {"sand", "rock"}), Catch::Contains("expected sand\nrock"));
  CHECK_THROWS_WITH(read_checkpoint(found, colourless.warehouse, groups),
                    Catch::Contains("particles/clay/colour of 3 bytes, expected particles/clay/number of 8 bytes"));
}

TEST_CASE("ranks together write the checkpoint that one process writes", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  if (world.is_first()) write(folder.path() / "alone", 7, 1);

  write(folder.path() / "together", 7, 1, 2, world);

  CHECK(all_datasets(folder.path() / "together" / "step_00000007.h5") ==
        all_datasets(folder.path() / "alone" / "step_00000007.h5"));
  CHECK(all_datasets(folder.path() / "together" / "step_00000007.h5").size() == 28);
}

TEST_CASE("a checkpoint of any number of ranks resumes on any other", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  std::vector<std::string> refused;

  write(folder.path(), 7, 1, 2, world);
  const FoundCheckpoint found = newest_checkpoint(folder.path(), refused, world).value();

  CHECK(resumed(found) == filled(1));
  CHECK(resumed(found, world, 1) == filled(1, world, 1));
}

TEST_CASE("ranks without particles write and read a checkpoint", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  StateScene scene(world);
  std::vector<std::string> refused;

  write_checkpoint(folder.path(), {0, 0, ""}, {}, scene.warehouse, groups, 1, world);
  const auto found = newest_checkpoint(folder.path(), refused, world);

  REQUIRE(found);
  CHECK(resumed(*found, world) == scene.bytes());
}

TEST_CASE("all ranks refuse a damaged checkpoint with the same reason and take the one before", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  write(folder.path(), 7, 1, 2, world);
  write(folder.path(), 8, 2, 2, world);
  if (world.is_first()) fs::resize_file(folder.path() / "step_00000008.h5", 20000);
  std::vector<std::string> refused;

  const auto found = newest_checkpoint(folder.path(), refused, world);

  REQUIRE(found);
  CHECK(found->header.step == 7);
  REQUIRE(refused.size() == 1);
  CHECK_THAT(refused[0], Catch::Contains("step_00000008.h5: has 20000 bytes instead of"));
  CHECK(world.gather(refused[0]).back() == world.gather(refused[0]).front());
}

TEST_CASE("a checkpoint for which there is no room is an error on all ranks", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  write(folder.path(), 7, 1, 1, world);

  {
    const FileSizeLimit limit(20000);
    CHECK_THROWS_AS(write(folder.path(), 8, 2, 1, world), FileError);
  }
  world.barrier();  // The first rank clears up after all have heard of the failure.

  CHECK(names_in(folder.path()) == std::vector<std::string>{"step_00000007.h5"});
}

TEST_CASE("a checkpoint that is written from a copy is of the moment at which the copy was made", "[ranks]")
{
  const Communicator world = Communicator::world();
  const TemporaryFolder folder(world);
  const auto one_by_one = [](int n, const auto& work) {
    for (int i = 0; i < n; ++i) work(i);
  };
  if (world.is_first()) write(folder.path() / "alone", 7, 1);
  StateScene scene(world);
  scene.fill(1);

  CheckpointCopy copy =
      copy_checkpoint({7, 0.1 * 7, "scene"}, as_bytes("host"), scene.warehouse, groups, one_by_one, world);
  scene.fill(2);
  if (world.is_first()) write_checkpoint(folder.path() / "copied", std::move(copy), 2);
  world.barrier();

  CHECK(all_datasets(folder.path() / "copied" / "step_00000007.h5") ==
        all_datasets(folder.path() / "alone" / "step_00000007.h5"));
  std::vector<std::string> refused;
  const FoundCheckpoint found = newest_checkpoint(folder.path() / "copied", refused, world).value();
  CHECK(resumed(found, world, 1) == filled(1, world, 1));
}

}  // namespace test_checkpoint
