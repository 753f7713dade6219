#include <catch2/catch.hpp>

#include "tests/tools/program.hpp"

using namespace tamp::test;

namespace
{

const std::string sand = TAMP_SOURCE_DIR "/inputs/materials/concrete-sand/table.json";
const std::string compression =
    "time,F11,F12,F13,F21,F22,F23,F31,F32,F33\n"
    "0,1,0,0,0,1,0,0,0,1\n"
    "1,0.99,0,0,0,1,0,0,0,1\n";

}  // namespace

TEST_CASE("drive names its columns with units and begins with the initial state")
{
  const TemporaryFolder folder;
  const std::string path = folder.write("path.csv", compression).string();

  const Outcome outcome = tamp_with("drive " + sand + " " + path + " --increment 0.1");

  CHECK(outcome.exit_code == 0);
  CHECK_THAT(outcome.out,
             Catch::StartsWith("time[s],F11,F12,F13,F21,F22,F23,F31,F32,F33,strain_v[-],p[Pa],q[Pa],s11[Pa],s22[Pa],"
                               "s33[Pa],s23[Pa],s13[Pa],s12[Pa],elastic_v[-],plastic_v[-],cap[Pa],K[Pa],G[Pa],"
                               "substeps,in_range,outside[-],plastic_work[J/m3]\n"
                               "0,1,0,0,0,1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,100000,"));
  CHECK_THAT(outcome.out, Catch::Contains("\n1,0.99,0,0,0,1,0,0,0,1,0.01005"));
}

TEST_CASE("drive writes the same to a file, and leaves stdout empty")
{
  const TemporaryFolder folder;
  const std::string line = "drive " + sand + " " + folder.write("path.csv", compression).string();
  const std::filesystem::path file = folder.path() / "out.csv";

  const Outcome outcome = tamp_with(line + " --out " + file.string());

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out.empty());
  CHECK(read_text(file) == tamp_with(line).out);
}

TEST_CASE("drive ends with 2 for a bad path, material or increment, and with 4 for a file that cannot be written")
{
  const TemporaryFolder folder;
  const std::string path = folder.write("path.csv", compression).string();
  const std::string one_row = folder.write("one_row.csv", compression.substr(0, compression.find("1,0.99"))).string();

  CHECK(tamp_with("drive " + sand + " " + one_row).err == "tamp: " + one_row + ": 1 rows; expected two or more\n");
  CHECK(tamp_with("drive " + sand + " " + one_row).exit_code == 2);
  CHECK(tamp_with("drive " + sand + " " + path + " --set /poisson_ratio=1").exit_code == 2);
  CHECK(tamp_with("drive " + sand + " " + path + " --increment 0.5").exit_code == 2);
  CHECK(tamp_with("drive " + sand + " " + path + " --out /no/such/folder/out.csv").exit_code == 4);
}
