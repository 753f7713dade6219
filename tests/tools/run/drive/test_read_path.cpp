#include <catch2/catch.hpp>
#include <numbers>

#include "runtime/file_error.hpp"
#include "tests/tools/temporary_folder.hpp"
#include "tools/run/drive/read_path.hpp"
#include "tools/system/errors.hpp"

namespace test_read_path
{

using namespace tamp;
using tools::DeformationPath;
using tools::MixedPath;
using tools::read_path;

namespace
{

const std::string at_rest = "0 1 0 0 0 1 0 0 0 1 0 0 0 1\n";

/// Problems of a path that cannot be read, without the folder's name.
std::string problem(const std::string& text)
{
  const test::TemporaryFolder folder;
  const std::string file = folder.write("path", text).string();
  try {
    read_path(file);
  } catch (const tools::InputError& error) {
    std::string said = error.what();
    for (std::size_t at = said.find(file); at != std::string::npos; at = said.find(file))
      said.replace(at, file.size(), "P");
    return said;
  }
  return "";
}

}  // namespace

TEST_CASE("a path in CSV is read by the names of its columns")
{
  const test::TemporaryFolder folder;

  const auto file = folder.write("path.csv",
                                 "# shear\ntime,F11,F21,F12,F13,F22,F23,F31,F32,F33\n"
                                 "0,1,0,0,0,1,0,0,0,1\n\n2,1.5,0.7,0.8,0,1,0,0,0,100\n");
  const auto path = std::get<DeformationPath>(read_path(file));

  REQUIRE(path.rows().size() == 2);
  CHECK(path.rows()[1].time == 2);
  CHECK(path.rows()[1].deformation_gradient == (Matrix<3>() << 1.5, 0.8, 0, 0.7, 1, 0, 0, 0, 100).finished());
  CHECK(path.rows()[1].angle == 0);
}

TEST_CASE("shear that a path in CSV has no column of is 0")
{
  const test::TemporaryFolder folder;

  const auto path =
      std::get<DeformationPath>(read_path(folder.write("path.csv", "time,F11,F22,F33\n0,1,1,1\n1,2,3,4\n")));

  CHECK(path.rows()[1].deformation_gradient == Matrix<3>(Vector<3>(2, 3, 4).asDiagonal()));
}

TEST_CASE("columns of stress take the place of those of deformation")
{
  const test::TemporaryFolder folder;

  const auto path = std::get<MixedPath>(
      read_path(folder.write("path.csv", "time, F11 ,S33,F22,F21,S12\n0,1,0,1,0,0\n1,0.95,-1e5,1.1,0.2,3e4\n")));

  REQUIRE(path.controls().size() == 2);
  CHECK(path.controls()[0].name == "S12");
  CHECK(path.controls()[1].name == "S33");
  CHECK(path.rows()[1].time == 1);
  CHECK(path.rows()[1].stress == std::vector<double>{3e4, -1e5});
  CHECK(path.rows()[1].deformation_gradient == (Matrix<3>() << 0.95, 0, 0, 0.2, 1.1, 0, 0, 0, 0).finished());
}

TEST_CASE("columns that do not go together are refused with their line, all at once")
{
  CHECK(problem("# mixed\ntime,F11,S11,F22,F33\n0,1,0,1,1\n1,1,0,1,1\n") ==
        "P:2: columns F11 and S11; expected one of them");
  CHECK(problem("time,S11,S22,S33,F12,S12\n0,0,0,0,0,0\n") == "P:1: columns F12 and S12; expected one of them");
  CHECK(problem("F11,F22,S33,S21\n1,1,0,0\n") ==
        "P:1: column \"S21\"; expected time, F11 to F33, S11, S22, S33, S12, S13 or S23\nP:1: no column time; expected "
        "one");
  CHECK(problem("time,F11,F22,S33,S33\n0,1,1,0,0\n") == "P:1: column S33 twice; expected it once");
  CHECK(problem("time,F11,F22,S33\n0,1,1,x\n1,1,1,0\n") == "P:2: \"x\" for S33; expected a finite number");
  CHECK(problem("time,F11,F22,S33\n0,1,1,0\n") == "P: 1 rows; expected two or more");
  CHECK(problem("time,F11,F22,S33\n0,1,1,0\n1,1,1\n") == "P:3: 3 values; expected 4");
  CHECK(problem("time,F11,F22,S33\n0,1,1,0\n0,1,1,0\n") == "P:3: time 0 after 0; expected times that rise");
  CHECK(problem("time,F11,F22,S33\n0,1,1,0\n1,1,0,0\n") == "P:3: F22 = 0; expected a stretch above 0");
  CHECK(problem("time,F11,F22,S33,F12,F21\n0,1,1,0,2,2\n1,1,1,0,0,0\n") ==
        "P:2: det F = -3; expected a determinant above 0");
}

TEST_CASE("prescribed deformation is read row by row, with its rotation in degrees")
{
  const test::TemporaryFolder folder;

  const auto path = std::get<DeformationPath>(
      read_path(folder.write("path.inp", at_rest + "1.\t1 .5 0  0 1 0  0 0 2   90 0 3 0\r\n")));

  REQUIRE(path.rows().size() == 2);
  CHECK(path.rows()[1].deformation_gradient == (Matrix<3>() << 1, 0.5, 0, 0, 1, 0, 0, 0, 2).finished());
  CHECK(path.rows()[1].angle == Approx(std::numbers::pi / 2));
  CHECK(path.rows()[1].axis == Vector<3>(0, 3, 0));
}

TEST_CASE("a path that cannot be used is refused with file and line")
{
  CHECK(problem("") == "P: an empty path; expected two or more rows");
  CHECK(problem("# only\n" + at_rest) == "P: 1 rows; expected two or more");
  CHECK(problem("time,F11\n0,1\n1,1\n") ==
        "P:1: neither F22 nor S22; expected one of them\nP:1: neither F33 nor S33; expected one of them");
  CHECK(problem(at_rest + "1 1 0 0 0 1 0 0 0 1\n") ==
        "P:2: 10 values; expected 14: time, F row by row, angle in degrees, axis");
  CHECK(problem(at_rest + "1 1 0 0 0 1,0 0 0 0 nan 1e999 0 0 1\n") ==
        "P:2: \"1,0\"; expected a finite number\nP:2: \"nan\"; expected a finite number\n"
        "P:2: \"1e999\"; expected a finite number");
  CHECK(problem("# a comment\n" + at_rest + at_rest) == "P:3: time 0 after 0; expected times that rise");
  CHECK(problem(at_rest + "1 -1 0 0 0 1 0 0 0 1 0 0 0 1\n") == "P:2: det F = -1; expected a determinant above 0");
  CHECK(problem(at_rest + "1 1 0 0 0 1 0 0 0 1 30 0 0 0\n") ==
        "P:2: a rotation about the axis 0 0 0; expected an axis");
}

TEST_CASE("a path that is not there is an error of the input")
{
  CHECK_THROWS_AS(read_path("/no/such/path.csv"), tools::InputError);
}

}  // namespace test_read_path
