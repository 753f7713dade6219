#include <catch2/catch.hpp>

#include <nlohmann/json.hpp>

#include "runtime/file_error.hpp"
#include "tests/tools/problems.hpp"
#include "tests/tools/scene/small_models.hpp"
#include "tools/scene/materials/read_support_vectors.hpp"

namespace test_read_support_vectors
{

using namespace tamp;
using namespace tamp::test;
using nlohmann::json;
using tools::read_support_vectors;

namespace
{

std::string problems_of_text(const std::string& text)
{
  const TemporaryFolder folder;
  const auto file = folder.write("svr.json", text);
  return problems_of_reading(folder, [&] { read_support_vectors(file); });
}

/// The small regression after one change.
std::string problems_with(const char* pointer, const json& value)
{
  json content = json::parse(small_regression);
  content[json::json_pointer(pointer)] = value;
  return problems_of_text(content.dump());
}

}  // namespace

TEST_CASE("a support-vector regression is read as published")
{
  const TemporaryFolder folder;

  const components::SupportVectorFit fit = read_support_vectors(folder.write("svr.json", small_regression));

  CHECK(fit.total.unit == 0.01);
  CHECK(fit.total.lower == -10);
  CHECK(fit.plastic.upper == 25);
  CHECK(fit.plastic.scale == 0.04);
  CHECK(fit.pressure_unit == 1e6);
  CHECK(fit.pressure_scale == 1e-3);
  CHECK(fit.pressure_lower == -200);
  CHECK(fit.gamma == 0.5);
  CHECK(fit.intercept == 0.4);
  CHECK(fit.vectors == std::vector<std::array<double, 2>>{{1.2, 0}, {1.1, 1}, {-0.1, 0.5}});
  CHECK(fit.coefficients == std::vector<double>{1, 0.5, -0.25});
}

TEST_CASE("a number of a regression may stand alone, in a list, or in a list of lists")
{
  const TemporaryFolder folder;
  json content = json::parse(small_regression);
  content["y_scale"] = 1e-3;
  content["gamma"] = {0.5};
  content["intercept"] = {{0.4}};
  content["X_scale"] = {{0.02}, {0.04}};
  content["X_min"] = {{-10, 0}};
  content["dual_coeffs"] = {1, 0.5, -0.25};

  const components::SupportVectorFit fit = read_support_vectors(folder.write("svr.json", content.dump()));

  CHECK(fit.pressure_scale == 1e-3);
  CHECK(fit.gamma == 0.5);
  CHECK(fit.intercept == 0.4);
  CHECK(fit.plastic.scale == 0.04);
  CHECK(fit.total.lower == -10);
  CHECK(fit.coefficients.size() == 3);
}

TEST_CASE("keys of a regression that are missing are reported, all at once")
{
  const std::string problems = problems_of_text("{}");

  CHECK_THAT(problems, Catch::Contains("svr.json#/gamma: missing; expected a number above 0"));
  CHECK_THAT(problems, Catch::Contains("svr.json#/X_scale: missing; expected 2 numbers, each above 0"));
  CHECK_THAT(problems, Catch::Contains("svr.json#/support_vectors: missing; expected a list that is not empty"));
  CHECK_THAT(problems, Catch::Contains("svr.json#/dual_coeffs: missing; expected a list that is not empty"));
}

TEST_CASE("numbers of a regression that are none, or out of range, are reported with their place")
{
  CHECK(problems_with("/gamma", "0.5") == "svr.json#/gamma: \"0.5\"; expected a number above 0");
  CHECK(problems_with("/gamma", -1) == "svr.json#/gamma: -1; expected a number above 0");
  CHECK(problems_with("/intercept", {1, 2}) == "svr.json#/intercept: [1,2]; expected a number");
  CHECK(problems_with("/y_scale", nullptr) == "svr.json#/y_scale: missing; expected a number above 0");
  CHECK(problems_with("/X_scale", {0.1, 0}) == "svr.json#/X_scale: [0.1,0]; expected 2 numbers, each above 0");
  CHECK(problems_with("/X_max", {40, 0}) == "svr.json#/X_max: [40, 0]; expected more than X_min, [-10, 0]");
}

TEST_CASE("ragged vectors and lists of other lengths are reported with their place")
{
  CHECK(problems_with("/support_vectors/1", {1}) == "svr.json#/support_vectors/1: [1]; expected two numbers");
  CHECK(problems_with("/support_vectors/2/0", "x") == "svr.json#/support_vectors/2: [\"x\",0.5]; expected two numbers");
  CHECK(problems_with("/support_vectors", json::array()) ==
        "svr.json#/support_vectors: an empty list; expected a list that is not empty");
  CHECK(problems_with("/dual_coeffs/0/1", nullptr) == "svr.json#/dual_coeffs/0/1: null; expected a number");
  CHECK(problems_with("/dual_coeffs/0", {1, 2}) ==
        "svr.json#/dual_coeffs/0: 2 numbers; expected 3, one for each support vector");
}

TEST_CASE("text that is no JSON, and a file that does not exist, are reported")
{
  CHECK_THAT(problems_of_text(R"({"gamma": NaN})"), Catch::StartsWith("svr.json:1:"));
  CHECK_THROWS_AS(read_support_vectors("/no/such/svr.json"), tools::InputError);
}

}  // namespace test_read_support_vectors
