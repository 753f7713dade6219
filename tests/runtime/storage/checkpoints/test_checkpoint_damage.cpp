#include <hdf5.h>

#include <catch2/catch.hpp>

#include "runtime/storage/checkpoints/checkpoint.hpp"
#include "runtime/storage/checkpoints/sealed_file.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/storage/checkpoints/state_scene.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_checkpoint_damage
{

using namespace tamp::test;

namespace
{

/// A folder with checkpoints of steps 10 and 20, the second of which is damaged.
struct Damaged {
  Damaged()
  {
    StateScene scene;
    scene.fill();
    for (const int step : {10, 20}) write_checkpoint(folder.path(), {step, 0, ""}, {}, scene.warehouse, groups, 2);
    whole = read_text(file());
  }

  std::filesystem::path file() const { return folder.path() / "step_00000020.h5"; }

  /// The step that is found, and why not the other.
  std::pair<std::int64_t, std::string> find() const
  {
    std::vector<std::string> refused;
    const auto found = newest_checkpoint(folder.path(), refused);
    return {found ? found->header.step : -1, refused.size() == 1 ? refused[0] : ""};
  }

  TemporaryFolder folder;
  std::string whole;
};

/// Sets the first value of a dataset, or an attribute of the file, as damage before the file was sealed would.
void tamper(const std::filesystem::path& file, const char* name, std::int64_t value)
{
  const hid_t f = H5Fopen(file.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
  if (H5Aexists(f, name) > 0) {
    const hid_t a = H5Aopen(f, name, H5P_DEFAULT);
    H5Awrite(a, H5T_NATIVE_INT64, &value);
    H5Aclose(a);
  } else {
    const hid_t d = H5Dopen2(f, name, H5P_DEFAULT);
    const hid_t space = H5Dget_space(d);
    std::vector<std::int64_t> values(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
    H5Dread(d, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    values.front() = value;
    H5Dwrite(d, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Sclose(space);
    H5Dclose(d);
  }
  H5Fclose(f);
  seal(file, {});
}

}  // namespace

TEST_CASE("a checkpoint in which a byte has changed is refused, wherever it is, and the one before is used")
{
  const Damaged damaged;
  constexpr std::size_t stride = TAMP_SANITIZED ? 7 : 1;

  std::size_t n_refused = 0, n_tried = 0;
  for (std::size_t at = 0; at < damaged.whole.size(); at += at < 640 ? stride : 61 * stride) {
    std::string flipped = damaged.whole;
    flipped[at] = static_cast<char>(flipped[at] ^ 0x10);
    write_text(damaged.file(), flipped);
    const auto [step, reason] = damaged.find();
    n_refused += step == 10 && reason.starts_with(damaged.file().string() + ": ");
    ++n_tried;
  }

  CHECK(n_tried > 700 / stride);
  CHECK(n_refused == n_tried);
}

TEST_CASE("a checkpoint that is cut off or empty is refused with its length, and the one before is used")
{
  const Damaged damaged;
  const std::size_t n = damaged.whole.size();

  for (const std::size_t length : {n - 1, n / 2, std::size_t{513}}) {
    write_text(damaged.file(), damaged.whole.substr(0, length));
    CHECK(damaged.find().first == 10);
    CHECK_THAT(damaged.find().second,
               Catch::EndsWith("has " + std::to_string(length) + " bytes instead of " + std::to_string(n)));
  }
  write_text(damaged.file(), "");
  CHECK(damaged.find().first == 10);
  CHECK_THAT(damaged.find().second, Catch::EndsWith("is cut off at byte 0"));
}

TEST_CASE("a file that only has the name of a checkpoint is refused")
{
  const Damaged damaged;

  write_text(damaged.file(), std::string(2000, 'x'));

  CHECK(damaged.find().first == 10);
  CHECK_THAT(damaged.find().second, Catch::EndsWith("is not sealed, or its seal is damaged"));
}

TEST_CASE("a checkpoint that was damaged on its way from memory to the file is refused with the place")
{
  const Damaged damaged;

  tamper(damaged.file(), "particles/sand/number", 4711);

  CHECK(damaged.find().first == 10);
  CHECK_THAT(damaged.find().second, Catch::EndsWith("is damaged in particles/sand/number of patch 1"));
}

TEST_CASE("a checkpoint that claims more or fewer values than it has is refused before memory is taken for them")
{
  for (const std::int64_t n : {std::int64_t{0}, std::int64_t{1} << 40, std::int64_t{1} << 60}) {
    const Damaged damaged;

    tamper(damaged.file(), "by_patch/particles/clay/place", n);

    CHECK(damaged.find().first == 10);
    CHECK_THAT(damaged.find().second, Catch::EndsWith("is damaged in how many values particles/clay/place has"));
  }
}

TEST_CASE("a checkpoint of another format is refused with both versions")
{
  const Damaged damaged;

  tamper(damaged.file(), "format", 1);

  CHECK(damaged.find().first == 10);
  CHECK_THAT(damaged.find().second, Catch::EndsWith("is of format 1, this program reads 8"));
}

TEST_CASE("where every checkpoint is damaged none is found")
{
  const Damaged damaged;
  std::vector<std::string> refused;

  for (const char* name : {"step_00000010.h5", "step_00000020.h5"}) write_text(damaged.folder.path() / name, "");

  CHECK_FALSE(newest_checkpoint(damaged.folder.path(), refused));
  CHECK(refused.size() == 2);
}

}  // namespace test_checkpoint_damage
