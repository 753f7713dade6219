#include <hdf5.h>
#include <sys/stat.h>

#include <array>
#include <catch2/catch.hpp>
#include <filesystem>

#include "runtime/file_error.hpp"
#include "runtime/storage/fields/field_file.hpp"
#include "runtime/storage/temporary_folder.hpp"
#include "tests/runtime/storage/fields/two_particles.hpp"
#include "tests/runtime/storage/file_size_limit.hpp"
#include "tests/runtime/storage/stored_data.hpp"

namespace test_field_file
{

using namespace tamp::runtime;
using namespace tamp::test;

namespace
{

namespace fs = std::filesystem;

double read_time(const fs::path& file, const std::string& group)
{
  double time = -1;
  const hid_t f = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t a = H5Aopen_by_name(f, group.c_str(), "time", H5P_DEFAULT, H5P_DEFAULT);
  H5Aread(a, H5T_NATIVE_DOUBLE, &time);
  H5Aclose(a);
  H5Fclose(f);
  return time;
}

}  // namespace

TEST_CASE("what is written to a field file is read back, filled up to three dimensions")
{
  const TemporaryFolder folder;
  const TwoParticles particles;
  const std::vector blocks{particles.block("sand")};
  const std::vector<double> node_mass{0, 1, 2, 3, 4, 5};
  const NodeBlock nodes{{0, 0, 0}, 0.1, {3, 2, 1}, {{"mass", ColumnKind::scalar, std::span(node_mass)}}};

  FieldFile file(folder.path());
  file.write_step(12, 0.5, blocks, nodes);

  const fs::path h5 = folder.path() / "fields.h5";
  const Dataset position = read_dataset(h5, "/step_00000012/particles/sand/position");
  const Dataset stress = read_dataset(h5, "/step_00000012/particles/sand/stress");
  const Dataset mass = read_dataset(h5, "/step_00000012/nodes/mass");
  CHECK(read_time(h5, "/step_00000012") == 0.5);
  CHECK(position.dimensions == std::vector<hsize_t>{2, 3});
  CHECK(position.values == std::vector<double>{1, 2, 0, 3, 4, 0});
  CHECK(stress.dimensions == std::vector<hsize_t>{2, 6});
  CHECK(stress.values == std::vector<double>{11, 12, 0, 22, 0, 33, -11, -12, 0, -22, 0, -33});
  CHECK(mass.dimensions == std::vector<hsize_t>{1, 2, 3});
  CHECK(mass.values == node_mass);
}

TEST_CASE("particle ids keep all their 64 bits in a field file")
{
  const TemporaryFolder folder;
  const TwoParticles particles;

  FieldFile(folder.path()).write_step(0, 0, std::vector{particles.block("sand")});

  std::array<std::int64_t, 2> id{};
  const hid_t f = H5Fopen((folder.path() / "fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const hid_t d = H5Dopen2(f, "/step_00000000/particles/sand/id", H5P_DEFAULT);
  H5Dread(d, H5T_NATIVE_INT64, H5S_ALL, H5S_ALL, H5P_DEFAULT, id.data());
  H5Dclose(d);
  H5Fclose(f);
  CHECK(id[0] == particles.id[0]);
  CHECK(id[1] == particles.id[1]);
}

TEST_CASE("a tensor of six components is written in the order xx xy xz yy yz zz")
{
  const TemporaryFolder folder;
  const std::vector<double> position{0, 0, 0}, stress{11, 22, 33, 12, 23, 13};
  const ParticleBlock block{
      "a",
      1,
      {{"position", ColumnKind::vector, std::span(position)}, {"stress", ColumnKind::tensor, std::span(stress)}}};

  FieldFile(folder.path()).write_step(0, 0, std::vector{block});

  const Dataset read = read_dataset(folder.path() / "fields.h5", "/step_00000000/particles/a/stress");
  CHECK(read.values == std::vector<double>{11, 12, 13, 22, 23, 33});
}

TEST_CASE("the xdmf file names a dataset that exists for every column of every step, and leaves empty groups out")
{
  const TemporaryFolder folder;
  const TwoParticles particles;
  const std::vector<double> none;
  const ParticleBlock empty{"void", 0, {{"position", ColumnKind::vector, std::span(none)}}};
  FieldFile file(folder.path());

  file.write_step(0, 0, std::vector{particles.block("sand"), empty});
  file.write_step(10, 1e-3, std::vector{particles.block("sand"), empty});

  const std::string text = read_text(folder.path() / "fields.xdmf");
  CHECK(count(text, "<Time Value=") == 2);
  CHECK(count(text, "void") == 0);
  std::size_t n_datasets = 0;
  const hid_t f = H5Fopen((folder.path() / "fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  for (std::size_t at = text.find("fields.h5:"); at != std::string::npos; at = text.find("fields.h5:", at + 1)) {
    const std::size_t begin = at + std::string("fields.h5:").size();
    const std::string name = text.substr(begin, text.find('<', begin) - begin);
    INFO(name);
    CHECK(H5Oexists_by_name(f, name.c_str(), H5P_DEFAULT) > 0);
    ++n_datasets;
  }
  H5Fclose(f);
  CHECK(n_datasets == 10);
}

TEST_CASE(
    "each point of the xdmf file names its particle, in one list that is written again only where it is too short")
{
  const TemporaryFolder folder;
  const std::vector<double> position{1, 2, 3, 4, 5, 6, 7, 8};
  const auto block = [&](std::size_t n) {
    return std::vector{ParticleBlock{"a", n, {{"position", ColumnKind::vector, std::span(position).first(2 * n)}}}};
  };
  FieldFile file(folder.path());

  for (const std::size_t n : {3U, 2U, 4U}) file.write_step(static_cast<std::int64_t>(10 - n), 0.1, block(n));

  const std::string text = read_text(folder.path() / "fields.xdmf");
  CHECK(count(text,
              ">0 1 3</DataItem><DataItem Dimensions=\"3\" NumberType=\"Int\" Precision=\"8\" Format=\"HDF\">"
              "fields.h5:/step_00000007/vertices<") == 1);
  CHECK(count(text, ">0 1 2</DataItem><DataItem Dimensions=\"3\"") == 1);
  CHECK(count(text, "fields.h5:/step_00000006/vertices<") == 1);
  CHECK(count(text, "/vertices<") == 3);
  CHECK(read_dataset(folder.path() / "fields.h5", "/step_00000007/vertices").values == std::vector<double>{0, 1, 2});
  CHECK(read_dataset(folder.path() / "fields.h5", "/step_00000006/vertices").values == std::vector<double>{0, 1, 2, 3});
}

TEST_CASE("the fields of the steps so far can be read while the field file is still in use")
{
  const TemporaryFolder folder;
  const TwoParticles particles;
  FieldFile file(folder.path());
  file.write_step(1, 0.1, std::vector{particles.block("sand")});

  const hid_t reader = H5Fopen((folder.path() / "fields.h5").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  const bool has_step = H5Lexists(reader, "/step_00000001", H5P_DEFAULT) > 0;
  H5Fclose(reader);

  CHECK(has_step);
  CHECK_NOTHROW(file.write_step(2, 0.2, std::vector{particles.block("sand")}));
}

TEST_CASE("columns whose lengths disagree are refused by a field file")
{
  const TemporaryFolder folder;
  const std::vector<double> position{0, 0, 0, 0, 0};
  const ParticleBlock block{"a", 2, {{"position", ColumnKind::vector, std::span(position)}}};
  FieldFile file(folder.path());

  CHECK_THROWS_AS(file.write_step(0, 0, std::vector{block}), std::invalid_argument);
}

TEST_CASE("a step that is written twice is an error that names the file and the step")
{
  const TemporaryFolder folder;
  const TwoParticles particles;
  FieldFile file(folder.path());
  file.write_step(3, 0.1, std::vector{particles.block("sand")});

  CHECK_THROWS_WITH(file.write_step(3, 0.1, std::vector{particles.block("sand")}),
                    Catch::Contains("fields.h5") && Catch::Contains("cannot write step 3"));
}

TEST_CASE("a folder that does not exist is an error that names the field file and the cause")
{
  CHECK_THROWS_AS(FieldFile("/no/such/folder"), FileError);
  CHECK_THROWS_WITH(FieldFile("/no/such/folder"),
                    Catch::Contains("/no/such/folder/fields.h5") && Catch::Contains("No such file or directory"));
}

TEST_CASE("a field file is no longer than what is in it, in spite of the room that is reserved for a step")
{
  const TemporaryFolder folder;
  const TwoParticles particles;
  FieldFile file(folder.path());

  for (int step = 0; step < 10; ++step) file.write_step(step, step, std::vector{particles.block("sand")});

  CHECK(fs::file_size(folder.path() / "fields.h5") < 10 * 8192);
}

TEST_CASE("a file that may not grow ends a step with an error that says so, and the steps before stay readable")
{
  const TemporaryFolder folder;
  const TwoParticles particles;
  FieldFile file(folder.path());
  file.write_step(1, 0.1, std::vector{particles.block("sand")});
  const std::vector<double> many(3 * 1'000'000, 1.0);
  const ParticleBlock large{"sand", 1'000'000, {{"position", ColumnKind::vector, std::span(many)}}};

  std::string message;
  {
    const FileSizeLimit limit(1 << 20);
    try {
      file.write_step(2, 0.2, std::vector{large});
    } catch (const FileError& error) {
      message = error.what();
    }
  }

  CHECK_THAT(message, Catch::Contains("fields.h5") && Catch::Contains("File too large"));
  CHECK(read_dataset(folder.path() / "fields.h5", "/step_00000001/particles/sand/mass").values == particles.mass);
  CHECK(count(read_text(folder.path() / "fields.xdmf"), "<Time Value=") == 1);
}

TEST_CASE("fields that were removed, replaced or cut after they were written are told of")
{
  const TemporaryFolder folder;
  const fs::path h5 = folder.path() / "fields.h5";
  const TwoParticles particles;
  const std::vector blocks{particles.block("sand")};
  FieldFile file(folder.path());
  file.write_step(1, 0.1, blocks);
  CHECK_NOTHROW(file.expect_as_written());

  SECTION("removed")
  {
    fs::remove(h5);
    CHECK_THROWS_WITH(file.expect_as_written(), Catch::Contains("fields.h5: was removed"));
  }
  SECTION("replaced")
  {
    fs::copy_file(h5, folder.path() / "copy.h5");
    fs::rename(folder.path() / "copy.h5", h5);
    CHECK_THROWS_WITH(file.expect_as_written(), Catch::Contains("fields.h5: was replaced"));
    CHECK_THROWS_AS(file.write_step(2, 0.2, blocks), FileError);
  }
  SECTION("cut")
  {
    fs::resize_file(h5, 100);
    CHECK_THROWS_WITH(file.expect_as_written(), Catch::Contains("it has 100 bytes of "));
  }
}

TEST_CASE("a pipe in the place of a field file is refused unopened")
{
  const TemporaryFolder folder;
  REQUIRE(mkfifo((folder.path() / "fields.h5").c_str(), 0600) == 0);

  CHECK_THROWS_AS(FieldFile(folder.path()), FileError);
  CHECK_THROWS_AS(FieldFile::continued(folder.path(), 1, 1), FileError);
}

}  // namespace test_field_file
