#include <hdf5.h>
#include <unistd.h>

#include <catch2/catch.hpp>

#include "runtime/file_error.hpp"
#include "runtime/storage/fields/field_file.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/storage/fields/two_particles.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_field_file_continued
{

using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

/// The output of a step: two groups, one of them empty, and six nodes.
void write(FieldFile& file, int step)
{
  const TwoParticles particles;
  const std::vector<double> none, node_mass{0, 1, 2, 3, 4, 5}, velocity(12, step);
  const std::vector blocks{particles.block("wet sand"),
                           ParticleBlock{"clay", 0, {{"position", ColumnKind::vector, std::span(none)}}}};
  const NodeBlock nodes{
      {-1, 0.5, 0},
      0.1,
      {3, 2, 1},
      {{"velocity", ColumnKind::vector, std::span(velocity)}, {"mass", ColumnKind::scalar, std::span(node_mass)}}};
  file.write_step(step, 1e-3 * step, blocks, nodes);
}

FieldFile written(const fs::path& folder, std::initializer_list<int> steps)
{
  FieldFile file(folder);
  for (const int step : steps) write(file, step);
  return file;
}

/// The rights of a user who is not root, where the tests run as root.
class NotRoot
{
 public:
  NotRoot()
  {
    constexpr uid_t nobody = 65534;
    if (root_) REQUIRE(seteuid(nobody) == 0);
  }
  ~NotRoot()
  {
    if (root_) static_cast<void>(seteuid(0) == 0);
  }
  NotRoot(const NotRoot&) = delete;
  NotRoot& operator=(const NotRoot&) = delete;

 private:
  bool root_ = geteuid() == 0;
};

}  // namespace

TEST_CASE("a field file that goes on after a step holds what one holds that never stopped")
{
  const TemporaryFolder folder, straight;
  written(straight.path(), {0, 10, 20, 30});
  written(folder.path(), {0, 10, 20, 25});

  FieldFile file = FieldFile::continued(folder.path(), 10, 2);
  for (const int step : {20, 30}) write(file, step);

  CHECK(file.notice().empty());
  CHECK(read_text(folder.path() / "fields.xdmf") == read_text(straight.path() / "fields.xdmf"));
  CHECK(all_datasets(folder.path() / "fields.h5") == all_datasets(straight.path() / "fields.h5"));
  CHECK(all_datasets(folder.path() / "fields.h5").size() == 4 * 7 + 1);
}

TEST_CASE("a field file that goes on before its first step is empty")
{
  const TemporaryFolder folder, fresh;
  written(folder.path(), {5});
  written(fresh.path(), {});

  FieldFile::continued(folder.path(), 4, 0);

  CHECK(all_datasets(folder.path() / "fields.h5").empty());
  CHECK(read_text(folder.path() / "fields.xdmf") == read_text(fresh.path() / "fields.xdmf"));
}

TEST_CASE("a damaged field file is set aside and told of, and a new one begun")
{
  const TemporaryFolder folder;
  const std::string text = "no longer a field file";
  written(folder.path(), {0, 10});
  write_text(folder.path() / "fields.h5", text);

  FieldFile file = FieldFile::continued(folder.path(), 10, 2);
  write(file, 20);

  CHECK_THAT(file.notice(), Catch::Contains("fields.h5: cannot be opened") &&
                                Catch::EndsWith("it was set aside as fields.h5.damaged and begun anew"));
  CHECK(read_text(folder.path() / "fields.h5.damaged") == text);
  CHECK(all_datasets(folder.path() / "fields.h5").size() == 7 + 1);
  CHECK(count(read_text(folder.path() / "fields.xdmf"), "<Time Value=") == 2);
}

TEST_CASE("a field file that is missing is begun anew and told of")
{
  const TemporaryFolder folder;

  FieldFile file = FieldFile::continued(folder.path(), 10, 2);
  write(file, 20);

  CHECK_THAT(file.notice(),
             Catch::EndsWith("fields.h5: is missing, with the 2 outputs until step 10; it was begun anew"));
  CHECK(all_datasets(folder.path() / "fields.h5").size() == 7 + 1);
}

TEST_CASE("a field file that lacks outputs keeps those it has, and tells how many were written")
{
  const TemporaryFolder folder;
  written(folder.path(), {0, 10});

  const FieldFile file = FieldFile::continued(folder.path(), 10, 3);

  CHECK_THAT(file.notice(), Catch::Contains("has 2 outputs until step 10, of 3 that were written"));
  CHECK(file.n_steps() == 2);
}

TEST_CASE("what a killed program had written of a step does not keep a field file from going on")
{
  const TemporaryFolder folder;
  written(folder.path(), {0, 10});
  const std::string before = read_text(folder.path() / "fields.h5");
  written(folder.path(), {0, 10, 20});
  const std::string after = read_text(folder.path() / "fields.h5");

  // All but the file's old part, in which the step is linked.
  write_text(folder.path() / "fields.h5", before + after.substr(before.size()));
  FieldFile file = FieldFile::continued(folder.path(), 10, 2);
  write(file, 20);

  CHECK(file.notice().empty());
  CHECK(all_datasets(folder.path() / "fields.h5").size() == 3 * 7 + 1);
}

TEST_CASE("a field file that was shortened before it noted its new length goes on")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "fields.h5";
  written(folder.path(), {0, 10, 20, 30});
  const std::string long_before = read_text(file).substr(0, 96);
  FieldFile::continued(folder.path(), 10, 2);
  const std::string shortened = read_text(file);

  // The first 96 bytes, which HDF5 writes last, say how long the file is.
  write_text(file, long_before + shortened.substr(96));
  REQUIRE(H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT) < 0);
  FieldFile fields = FieldFile::continued(folder.path(), 10, 2);
  write(fields, 20);

  CHECK(fields.notice().empty());
  CHECK(all_datasets(file).size() == 3 * 7 + 1);
  CHECK(fs::file_size(file) < 4 * 16384);
}

TEST_CASE("a field file that was cut in half is set aside as it was")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "fields.h5";
  written(folder.path(), {0, 10});
  const std::uintmax_t n_bytes = fs::file_size(file);

  fs::resize_file(file, n_bytes / 2);
  const FieldFile fields = FieldFile::continued(folder.path(), 10, 2);

  CHECK_THAT(fields.notice(), Catch::Contains("it was set aside"));
  CHECK(all_datasets(file).empty());
  CHECK(fs::file_size(folder.path() / "fields.h5.damaged") == n_bytes / 2);
}

TEST_CASE("a field file that may not be written is not taken for a damaged one")
{
  const TemporaryFolder folder;
  const fs::path file = folder.path() / "fields.h5";
  written(folder.path(), {0, 10});
  fs::permissions(folder.path(), fs::perms::all);
  fs::permissions(file, fs::perms::owner_read);
  {
    const NotRoot rights;
    CHECK_THROWS_WITH(FieldFile::continued(folder.path(), 10, 2), Catch::Contains("Permission denied"));
  }
  CHECK(fs::exists(file));
  CHECK_FALSE(fs::exists(file.string() + ".damaged"));
}

}  // namespace test_field_file_continued
