#include <catch2/catch.hpp>

#include <cmath>
#include <nlohmann/json.hpp>
#include <sstream>
#include <vector>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_models.hpp"
#include "tests/tools/scene/small_scene.hpp"

namespace test_modulus
{

using namespace tamp::test;

namespace
{

/// Answer of `tamp modulus FILE OPTIONS`.
Outcome modulus(const std::filesystem::path& file, const std::string& options)
{
  return tamp_with("modulus " + file.string() + " " + options);
}

/// The numbers of line `n` after the header.
std::vector<double> row(const Outcome& outcome, int n)
{
  std::istringstream lines(outcome.out);
  std::string line;
  for (int i = 0; i <= n + 1; ++i) std::getline(lines, line);
  std::vector<double> numbers;
  std::istringstream fields(line);
  for (std::string field; std::getline(fields, field, ',');) numbers.push_back(std::stod(field));
  return numbers;
}

}  // namespace

TEST_CASE("a mark of the bytes' order before a table or a material is passed over")
{
  const TemporaryFolder folder;
  write_sand(folder);
  const Outcome plain = modulus(folder.path() / "sand.json", "--at 0.001,0.05");
  for (const char* name : {"sand.json", "tables/unloading.csv", "tables/yield.csv"}) {
    folder.write(name, "\xef\xbb\xbf" + read_text(folder.path() / name));
  }

  CHECK(plain.exit_code == 0);
  CHECK(modulus(folder.path() / "sand.json", "--at 0.001,0.05").out == plain.out);
  CHECK(modulus(folder.path() / "tables/unloading.csv", "--at 0.001,0.05").exit_code == 0);
}

TEST_CASE("a model whose answers are no numbers is refused")
{
  const TemporaryFolder folder;
  const auto curves = folder.write("curves.csv",
                                   "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
                                   "0.05,0,0\n0.05,1e-10,1e300\n0.05,2e-10,1e301\n"
                                   "0.1,0,0\n0.1,1e-10,2e300\n0.1,2e-10,2e301\n");

  const Outcome outcome = modulus(curves, "--at 1e-10,0.05");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.out, !Catch::Contains("inf") && !Catch::Contains("nan"));
  CHECK_THAT(outcome.err, Catch::StartsWith("tamp: " + curves.string()));
}

TEST_CASE("a material is asked for pressure and moduli, as rows of numbers")
{
  const TemporaryFolder folder;
  write_sand(folder);

  const Outcome outcome = modulus(folder.path() / "sand.json", "--at 0.005,0.05 --at -0.001,0 --at 0.5,0");

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.err.empty());
  CHECK_THAT(outcome.out, Catch::StartsWith("elastic_v[-],plastic_v[-],p[Pa],K[Pa],G[Pa],dK_dplastic[Pa],in_range\n"));
  const std::vector<double> first = row(outcome, 0);
  REQUIRE(first.size() == 7);
  CHECK(first[0] == 0.005);
  CHECK(first[1] == 0.05);
  CHECK(first[2] == Approx(5e6).epsilon(2e-3));
  CHECK(first[3] == Approx(1e9).epsilon(5e-3));
  CHECK(first[4] / first[3] == Approx(0.75));
  CHECK(first[6] == 1);
  CHECK(row(outcome, 1)[2] < 0);
  CHECK(row(outcome, 2)[6] == 0);
}

TEST_CASE("a material is asked after its values are replaced")
{
  const TemporaryFolder folder;
  write_sand(folder);
  folder.write("svr.json", small_regression);

  const Outcome outcome =
      modulus(folder.path() / "sand.json",
              "--at 0.01,0.1 --set /modulus/type=svr --set /modulus/svr=" + (folder.path() / "svr.json").string());

  CHECK(outcome.exit_code == 0);
  const double x = (11 + 10) * 0.02, y = 0.4;
  const auto term = [&](double a, double s, double t) {
    return a * (s - x) * std::exp(-0.5 * ((s - x) * (s - x) + (t - y) * (t - y)));
  };
  CHECK(row(outcome, 0)[3] ==
        Approx(2e9 * (term(1, 1.2, 0) + term(0.5, 1.1, 1) + term(-0.25, -0.1, 0.5))).epsilon(1e-10));
}

TEST_CASE("a model's file is asked by itself, with a Poisson's ratio of its own")
{
  const TemporaryFolder folder;
  write_sand(folder);
  write_keras(folder.path() / "n.h5", {.layers = small_network.layers});
  const auto curves = folder.path() / "tables/unloading.csv";

  CHECK(modulus(folder.write("svr.json", small_regression), "--at 0.01,0.1").exit_code == 0);
  CHECK(modulus(folder.path() / "n.h5", "--at 0.01,0.1 --scaling 0.03,0.05,0.2,0.15,2e10,1e10").exit_code == 0);
  const std::vector<double> published = row(modulus(curves, "--at 0.005,0.05"), 0);
  CHECK(published[4] / published[3] == Approx(1.5 * (1 - 2 * 0.189) / 1.189));
  const std::vector<double> given = row(modulus(curves, "--at 0.005,0.05 --nu 0"), 0);
  CHECK(given[4] / given[3] == Approx(1.5));
}

TEST_CASE("a command line that asks for nothing sensible ends with 2 and says what was expected")
{
  const TemporaryFolder folder;
  write_sand(folder);
  const auto curves = folder.path() / "tables/unloading.csv";
  const auto problem = [&](const std::string& options) {
    const Outcome outcome = modulus(curves, options);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    return outcome.err;
  };

  for (const std::string at : {"0.1", "0.1,0.2,0.3", "a,0", "0.1,", "nan,0", "0,inf", "0.1;0"}) {
    INFO(at);
    CHECK_THAT(problem("--at '" + at + "'"),
               Catch::StartsWith("tamp: --at " + at + ": not 2 finite numbers; expected EE,EP"));
  }
  CHECK_THAT(problem(""), Catch::Contains("--at or --states is required"));
  CHECK_THAT(problem("--at 0,0 --nu 0.5"), Catch::StartsWith("tamp: --nu: 0.5; expected a number above -1"));
  CHECK_THAT(problem("--at 0,0 --set /density=1"), Catch::Contains("expected a material"));
  CHECK_THAT(problem("--at 0,0 --scaling 1,2,3,4,5,6"), Catch::Contains("no network"));
}

TEST_CASE("files that are no model, or are not there, end with 2 and their place")
{
  const TemporaryFolder folder;
  write_keras(folder.path() / "n.h5", {.layers = small_network.layers});
  folder.write("cut.h5", read_text(folder.path() / "n.h5").substr(0, 3000));
  folder.write("empty.json", "{}");
  folder.write("half.json", R"({"gamma": 1})");
  folder.write("words.txt", "some words\n");
  folder.write("steel.json", R"({"type":"hypoelastic","density":8000,"bulk_modulus":1e10,"shear_modulus":7e9})");
  const auto problem = [&](const std::string& file) {
    const Outcome outcome = modulus(folder.path() / file, "--at 0,0");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::StartsWith("tamp: " + (folder.path() / file).string()));
    return outcome.err;
  };

  CHECK_THAT(problem("n.h5"), Catch::Contains("a network without the attribute scaling; expected --scaling"));
  // The message is a single line, without HDF5's own account.
  CHECK_THAT(problem("cut.h5"), Catch::EndsWith("cut.h5: a damaged or truncated HDF5 file; expected an HDF5 file\n"));
  CHECK_THAT(problem("empty.json"), Catch::Contains("expected Vaango_tabular_data, support_vectors or a material"));
  CHECK_THAT(problem("half.json"), Catch::Contains("#/support_vectors: missing"));
  CHECK_THAT(problem("words.txt"), Catch::Contains(":1: columns some words; expected plastic_volumetric[-]"));
  CHECK_THAT(problem("steel.json"), Catch::Contains("#/type: a material without a model of its moduli"));
  CHECK(modulus("/no/such/model.h5", "--at 0,0").exit_code == 2);
}

TEST_CASE("the states of a file are answered as those of the command line")
{
  const TemporaryFolder folder;
  const auto curves = folder.write("unloading.csv",
                                   "plastic_volumetric[-],elastic_volumetric[-],pressure[Pa]\n"
                                   "0.05,0,0\n0.05,0.005,5e6\n0.05,0.01,1e7\n0.1,0,0\n0.1,0.005,1e7\n0.1,0.01,2e7\n");
  const auto states =
      folder.write("states.csv", "# two\nplastic_volumetric[-],elastic_volumetric[-]\n0.05,0.005\n0,-0.001\n");

  const Outcome outcome = modulus(curves, "--states " + states.string());
  modulus(curves, "--states " + states.string() + " --out " + (folder.path() / "out.csv").string());

  CHECK(outcome.exit_code == 0);
  CHECK(outcome.out == modulus(curves, "--at 0.005,0.05 --at -0.001,0").out);
  CHECK(read_text(folder.path() / "out.csv") == outcome.out);
}

TEST_CASE("a sand in rate form answers the states of a file with the integral of K, and tells how far it is off")
{
  const TemporaryFolder folder;
  write_sand(folder);
  // K is 1 GPa on the first curve and 2 GPa on the second; what is said to be measured is less on the first.
  const auto states = folder.write("states.csv",
                                   "elastic_volumetric[-],plastic_volumetric[-],pressure[Pa],bulk_modulus[Pa]\n"
                                   "0.005,0.05,4e6,0.5e9\n0.01,0.1,2e7,2e9\n");

  const Outcome outcome = modulus(folder.path() / "sand.json", "--states " + states.string());

  CHECK_THAT(outcome.out, Catch::StartsWith("elastic_v[-],plastic_v[-],p[Pa],K[Pa],G[Pa],dK_dplastic[Pa],in_range,"
                                            "p_error[-],p_error_rms[-],K_error[-],K_error_rms[-]\n"));
  const std::vector<double> first = row(outcome, 0), second = row(outcome, 1);
  REQUIRE(first.size() == 11);
  CHECK(first[2] == Approx(5e6));
  CHECK(first[3] == Approx(1e9));
  CHECK(first[7] == Approx(0.25));
  CHECK(first[8] == Approx(0.25));
  CHECK(first[9] == Approx(1));
  REQUIRE(second.size() == 11);
  CHECK(second[2] == Approx(2e7));
  CHECK(second[7] == Approx(0).margin(1e-9));
  CHECK(second[8] == Approx(0.25 / std::sqrt(2)));
  CHECK(second[10] == Approx(1 / std::sqrt(2)));
}

TEST_CASE("the cost of evaluations is reported with their number and the bytes of the model")
{
  const TemporaryFolder folder;
  const std::string sand = TAMP_SOURCE_DIR "/inputs/materials/concrete-sand/svr.json";
  const auto states =
      folder.write("states.csv", "plastic_volumetric[-],elastic_volumetric[-]\n0.05,0.005\n0.1,0.01\n0.2,0.01\n");
  const auto summary_with = [&](const std::string& options) {
    const auto file = folder.path() / "summary.json";
    CHECK(modulus(sand, "--states " + states.string() + " --summary " + file.string() + options).exit_code == 0);
    return nlohmann::json::parse(read_text(file));
  };

  const auto coarse = summary_with(" --set /modulus/compile=1e-2"), fine = summary_with(" --set /modulus/compile=1e-3");

  CHECK(coarse["evaluations"] == 3);
  CHECK(coarse["ns_per_evaluation"] > 0);
#ifndef __SANITIZE_ADDRESS__  // which has a heap of its own
  // At least the four numbers of each corner of the fewest patches there can be.
  CHECK(coarse["bytes"] > 16 * sizeof(double));
  CHECK(fine["bytes"] > coarse["bytes"]);
#endif
}

TEST_CASE("files of states that cannot be answered end with 2 and their place")
{
  const TemporaryFolder folder;
  write_sand(folder);
  const std::string header = "elastic_volumetric[-],plastic_volumetric[-],pressure[Pa],bulk_modulus[Pa]\n";
  const auto problem = [&](const std::string& content) {
    const Outcome outcome =
        modulus(folder.path() / "sand.json", "--states " + folder.write("states.csv", content).string());
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    return outcome.err;
  };
  const std::string place = "tamp: " + (folder.path() / "states.csv").string();

  CHECK_THAT(problem("plastic_volumetric[-]\n0\n"),
             Catch::StartsWith(place + ":1: columns plastic_volumetric[-]; expected elastic_volumetric[-],plastic"));
  CHECK_THAT(problem("elastic_volumetric[-],plastic_volumetric[-],pressure[Pa]\n0,0,1\n"),
             Catch::Contains("expected elastic_volumetric[-],plastic_volumetric[-],pressure[Pa],bulk_modulus[Pa]"));
  CHECK_THAT(problem(header + "0,0,1,1\n0,0,0,1\n"),
             Catch::StartsWith(place + ":3: pressure[Pa] 0; expected a number above 0"));
  CHECK_THAT(problem(header + "0,0,1,-2\n"),
             Catch::StartsWith(place + ":2: bulk_modulus[Pa] -2; expected a number above 0"));
  const std::string sand = (folder.path() / "sand.json").string(), states = folder.write("s.csv", header).string();
  CHECK(tamp_with("modulus " + sand + " --at 0,0 --states " + states).exit_code == 2);
  CHECK(tamp_with("modulus " + sand + " --at 0,0 --out " + (folder.path() / "out.csv").string()).exit_code == 2);
  CHECK(tamp_with("modulus " + sand + " --states /no/such/file.csv").exit_code == 2);
}

}  // namespace test_modulus
