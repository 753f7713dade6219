#include <catch2/catch.hpp>

#include <cmath>
#include <sstream>
#include <vector>

#include "tests/tools/program.hpp"
#include "tests/tools/scene/small_models.hpp"
#include "tests/tools/scene/small_scene.hpp"

using namespace tamp::test;

namespace
{

/// What `tamp modulus FILE OPTIONS` answers.
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
  const auto complaint = [&](const std::string& options) {
    const Outcome outcome = modulus(curves, options);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    return outcome.err;
  };

  for (const std::string at : {"0.1", "0.1,0.2,0.3", "a,0", "0.1,", "nan,0", "0,inf", "0.1;0"}) {
    INFO(at);
    CHECK_THAT(complaint("--at '" + at + "'"),
               Catch::StartsWith("tamp: --at " + at + ": not 2 finite numbers; expected EE,EP"));
  }
  CHECK_THAT(complaint(""), Catch::Contains("--at is required"));
  CHECK_THAT(complaint("--at 0,0 --nu 0.5"), Catch::StartsWith("tamp: --nu: 0.5; expected a number above -1"));
  CHECK_THAT(complaint("--at 0,0 --set /density=1"), Catch::Contains("expected a material"));
  CHECK_THAT(complaint("--at 0,0 --scaling 1,2,3,4,5,6"), Catch::Contains("no network"));
}

TEST_CASE("files that are no model end with 2 and their place, those that cannot be read with 4")
{
  const TemporaryFolder folder;
  write_keras(folder.path() / "n.h5", {.layers = small_network.layers});
  folder.write("cut.h5", read_text(folder.path() / "n.h5").substr(0, 3000));
  folder.write("empty.json", "{}");
  folder.write("half.json", R"({"gamma": 1})");
  folder.write("words.txt", "some words\n");
  folder.write("steel.json", R"({"type":"hypoelastic","density":8000,"bulk_modulus":1e10,"shear_modulus":7e9})");
  const auto complaint = [&](const std::string& file) {
    const Outcome outcome = modulus(folder.path() / file, "--at 0,0");
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.out.empty());
    CHECK_THAT(outcome.err, Catch::StartsWith("tamp: " + (folder.path() / file).string()));
    return outcome.err;
  };

  CHECK_THAT(complaint("n.h5"), Catch::Contains("a network without the attribute scaling; expected --scaling"));
  // One line: nothing of HDF5's own account.
  CHECK_THAT(complaint("cut.h5"), Catch::EndsWith("cut.h5: a damaged or truncated HDF5 file; expected an HDF5 file\n"));
  CHECK_THAT(complaint("empty.json"), Catch::Contains("expected Vaango_tabular_data, support_vectors or a material"));
  CHECK_THAT(complaint("half.json"), Catch::Contains("#/support_vectors: missing"));
  CHECK_THAT(complaint("words.txt"), Catch::Contains(":1: columns some words; expected plastic_volumetric[-]"));
  CHECK_THAT(complaint("steel.json"), Catch::Contains("#/type: a material without a model of its moduli"));
  CHECK(modulus("/no/such/model.h5", "--at 0,0").exit_code == 4);
}
