#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <catch2/catch.hpp>
#include <nlohmann/json.hpp>
#include <sstream>

#include "tests/tools/program.hpp"

namespace test_drive_command
{

using namespace tamp::test;

namespace
{

const std::string sand = TAMP_SOURCE_DIR "/inputs/materials/concrete-sand/table.json";
const std::string compression =
    "time,F11,F12,F13,F21,F22,F23,F31,F32,F33\n"
    "0,1,0,0,0,1,0,0,0,1\n"
    "1,0.99,0,0,0,1,0,0,0,1\n";

/// The sum of a column of a table that drive wrote.
double sum_of(const std::string& table, const std::string& name)
{
  std::istringstream lines(table);
  std::vector<std::string> names;
  double sum = 0;
  for (std::string line; std::getline(lines, line);) {
    std::istringstream fields(line);
    std::vector<std::string> row;
    for (std::string field; std::getline(fields, field, ',');) row.push_back(field);
    if (names.empty()) {
      names = row;
    } else {
      sum += std::stod(row[static_cast<std::size_t>(std::find(names.begin(), names.end(), name) - names.begin())]);
    }
  }
  return sum;
}

std::ptrdiff_t n_rows(const std::string& table)
{
  return std::count(table.begin(), table.end(), '\n') - 1;
}

/// The columns and rows that a page holds.
nlohmann::json rows_within(const std::string& page)
{
  const std::string start = R"(<script type="application/json" id="rows">)";
  const std::size_t from = page.find(start);
  REQUIRE(from != std::string::npos);
  const std::size_t begin = from + start.size();
  return nlohmann::json::parse(page.substr(begin, page.find("</script>", begin) - begin));
}

/// Clay with 2 c of 100 kPa, and a path to a stress of four times that.
std::string clay_beyond_its_strength(const TemporaryFolder& folder)
{
  const auto clay = folder.write("clay.json",
                                 R"({"type": "drucker_prager", "density": 2000, "bulk_modulus": 2e7,
                                     "shear_modulus": 1.2e7, "friction_angle": 0, "cohesion": 5e4})");
  return clay.string() + " " + folder.write("path.csv", "time,S11,S22,S33\n0,0,0,0\n1,-4e5,0,0\n").string();
}

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
                               "0,1,0,0,0,1,0,0,0,1,0,0,0,0,0,0,0,0,0,0,0,3163047.223,"));
  CHECK_THAT(outcome.out, Catch::Contains("\n1,0.99,0,0,0,1,0,0,0,1,0.01005"));
}

TEST_CASE(
    "a constant that is too large to calculate with is refused with its key, and a path's mark of bytes passed over")
{
  const TemporaryFolder folder;
  const std::string path = folder.write("path.csv", "\xef\xbb\xbf" + compression).string();
  const auto drive_with = [&](const std::string& bulk_modulus) {
    const std::string text = R"({"type": "neo_hookean", "density": 1000, "shear_modulus": 1e6, "bulk_modulus": )";
    return tamp_with("drive " + folder.write("rock.json", text + bulk_modulus + "}").string() + " " + path);
  };

  const Outcome huge = drive_with("1e300");

  CHECK(huge.exit_code == 2);
  CHECK(huge.out.empty());
  CHECK(huge.err == "tamp: " + (folder.path() / "rock.json").string() +
                        "#/bulk_modulus: 1e+300; expected a number of at most 1e+50\n");
  CHECK(drive_with("1e9").exit_code == 0);
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

TEST_CASE("drive makes a test of the laboratory in place of a path")
{
  const Outcome outcome = tamp_with("drive " + sand + " --test triaxial --pressure 5e6 --strain 0.01");

  CHECK(outcome.exit_code == 0);
  CHECK(sum_of(outcome.out, "s22[Pa]") == Approx(-5e6 * static_cast<double>(n_rows(outcome.out))));
}

TEST_CASE("drive takes either a path or a test, and of a test only what that has")
{
  const TemporaryFolder folder;
  const std::string path = folder.write("path.csv", compression).string();
  const auto said_of = [](const std::string& arguments) {
    const Outcome outcome = tamp_with("drive " + sand + " " + arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    return outcome.err;
  };

  CHECK(said_of("") == "tamp: PATH or --test is required; see tamp help drive\n");
  CHECK(said_of(path + " --test triaxial") == "tamp: PATH excludes --test\n");
  CHECK(said_of(path + " --pressure 1e5") == "tamp: --pressure requires --test\n");
  CHECK(said_of("--test triaxal") == "tamp: --test: triaxal; did you mean triaxial?\n");
  CHECK(said_of("--test triaxial --pressure -1") == "tamp: --pressure: -1; expected at least 0\n");
  CHECK(said_of("--test triaxial --strain 1") == "tamp: --strain: 1; expected -0.9 to 0.9\n");
  CHECK(said_of("--test isotropic --strain 0.1") ==
        "tamp: --strain: given with --test isotropic; expected --pressure, to which it goes\n");
  CHECK(said_of("--test oedometer --k0 1") ==
        "tamp: --k0: given with --test oedometer; expected no lateral stress, which it answers\n");
}

TEST_CASE("drive ends with 3 where the material cannot follow a stress, and has written the rows so far")
{
  const TemporaryFolder folder;

  const Outcome outcome = tamp_with("drive " + clay_beyond_its_strength(folder));

  CHECK(outcome.exit_code == 3);
  CHECK(
      outcome.err ==
      "tamp: the material cannot follow: S11 is -100000 Pa, and should be -400000 Pa at the end: at 0.25 s, on the way "
      "to row 2 of the path\n");
  CHECK(n_rows(outcome.out) > 3);
}

TEST_CASE("drive tells what the updates of a path cost, and writes the same stresses")
{
  const TemporaryFolder folder;
  const std::string line = "drive " + sand + " " + folder.write("path.csv", compression).string();
  const std::filesystem::path file = folder.path() / "summary.json";

  const Outcome outcome = tamp_with(line + " --repeat 2 --summary " + file.string());

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == tamp_with(line).out);
  const auto summary = nlohmann::json::parse(read_text(file));
  CHECK(summary["updates"] == n_rows(outcome.out) - 1);
  CHECK(summary["substeps"] == sum_of(outcome.out, "substeps"));
  CHECK(summary["modulus_evaluations"] >= summary["substeps"]);
  CHECK(summary["evaluations_per_update"].get<double>() ==
        Approx(summary["modulus_evaluations"].get<double>() / summary["updates"].get<double>()));
  CHECK(summary["ns_per_update"] > 0);
}

TEST_CASE("drive tells that a steel's updates evaluate no model of moduli, and take one substep each")
{
  const TemporaryFolder folder;
  const auto steel =
      folder.write("steel.json", R"({"type":"hypoelastic","density":8000,"bulk_modulus":1e10,"shear_modulus":7e9})");
  const std::filesystem::path path = folder.write("path.csv", compression), file = folder.path() / "summary.json";

  tamp_with("drive " + steel.string() + " " + path.string() + " --increment 0.1 --summary " + file.string());

  const auto summary = nlohmann::json::parse(read_text(file));
  CHECK(summary["updates"] == 1);
  CHECK(summary["modulus_evaluations"] == 0);
}

TEST_CASE("drive refuses rounds of a timing that is not asked for, and ends with 4 where a summary cannot be written")
{
  const TemporaryFolder folder;
  const std::string line = "drive " + sand + " " + folder.write("path.csv", compression).string();

  CHECK(tamp_with(line + " --repeat 3").exit_code == 2);
  CHECK(tamp_with(line + " --repeat 0 --summary " + (folder.path() / "s.json").string()).exit_code == 2);
  CHECK(tamp_with(line + " --summary /no/such/folder/summary.json").exit_code == 4);
}

TEST_CASE("drive draws the curves of a test into a page that holds its rows, and writes the same CSV", "[slow]")
{
  const TemporaryFolder folder;
  const std::string line = "drive " + sand + " --test triaxial --strain 0.01";
  const std::filesystem::path page = folder.path() / "page.html";

  const Outcome outcome = tamp_with(line + " --plot " + page.string());

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  CHECK(outcome.out == tamp_with(line).out);
  const std::string text = read_text(page);
  CHECK_THAT(text, Catch::Contains("q over axial shortening") && Catch::Contains("table.json, test triaxial"));
  std::istringstream lines(outcome.out);
  std::string header;
  std::getline(lines, header);
  const nlohmann::json within = rows_within(text);
  CHECK(fmt::format("{}", fmt::join(within["columns"].get<std::vector<std::string>>(), ",")) == header);
  for (const auto& row : within["rows"]) {
    std::string written;
    std::getline(lines, written);
    CHECK(fmt::format("{}", fmt::join(row.get<std::vector<double>>(), ",")) == written);
  }
  CHECK(lines.peek() == EOF);
}

TEST_CASE("the page of a drive is a file of its own, and one that can be written")
{
  const TemporaryFolder folder;
  const std::string line = "drive " + sand + " --test triaxial --strain 0.01 --plot ";
  const std::string out = (folder.path() / "out").string();

  const Outcome shared = tamp_with(line + out + " --out " + out);

  CHECK(shared.exit_code == 2);
  CHECK_THAT(shared.err, Catch::Contains("the file of --"));
  CHECK_FALSE(std::filesystem::exists(out));
  CHECK(tamp_with(line + "/no/such/folder/page.html").exit_code == 4);
}

TEST_CASE("a drive that fails leaves no page, and an old one as it was")
{
  const TemporaryFolder folder;
  const std::string line = "drive " + clay_beyond_its_strength(folder) + " --plot ";
  const auto old = folder.write("old.html", "as it was"), page = folder.path() / "page.html";

  CHECK(tamp_with(line + page.string()).exit_code == 3);
  CHECK(tamp_with(line + old.string()).exit_code == 3);

  CHECK_FALSE(std::filesystem::exists(page));
  CHECK(read_text(old) == "as it was");
}

TEST_CASE("without Python a drive ends with 4 and says how to draw its page, and keeps its rows")
{
  const TemporaryFolder folder;
  const std::string page = (folder.path() / "page.html").string(), out = (folder.path() / "out.csv").string();

  const Outcome outcome = outcome_of("TAMP_PYTHON=/nonexistent/python " TAMP_PROGRAM " drive " + sand +
                                     " --test triaxial --strain 0.01 --plot " + page + " --out " + out);

  CHECK(outcome.exit_code == 4);
  CHECK_THAT(outcome.err, Catch::Contains("python3-matplotlib") &&
                              Catch::EndsWith("tools/python/tamp drive-page ROWS.csv " + page + "\n"));
  CHECK(n_rows(read_text(out)) > 3);
  CHECK_FALSE(std::filesystem::exists(page));
}

}  // namespace test_drive_command
