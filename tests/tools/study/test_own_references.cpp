#include <catch2/catch.hpp>

#include "tests/tools/temporary_folder.hpp"
#include "tools/study/findings.hpp"
#include "tools/system/errors.hpp"

namespace test_own_references
{

using namespace tamp::tools;
using namespace tamp::tools::study;
using tamp::test::TemporaryFolder;

namespace
{

/// Two methods that tend to different answers as /t falls, each compared with itself.
Study two_methods()
{
  Study study;
  study.measure.kind = Measure::Kind::drive;
  const std::vector<Axis> coarse{{"/t", {Json(0.8)}}};
  study.methods = {{"one", "one", false, {{"/limit", Json(10)}}, coarse, {}},
                   {"other", "other", false, {{"/limit", Json(20)}}, coarse, {}}};
  Quantity pressure;
  pressure.name = pressure.column = "p[Pa]";
  study.quantities = {pressure};
  study.refine = "/t";
  study.reference = ReferenceRuns{{}, {"/t", {Json(0.4), Json(0.2), Json(0.1)}}, true};
  return study;
}

/// The limit and, as /t is not yet zero, two of it.
MeasuredPoint measured(const Point& point, const TemporaryFolder& folder)
{
  const double t = point.setting("/t").get<double>(), limit = point.setting("/limit").get<double>();
  const std::string name = std::to_string(point.id);
  folder.write(name + "/history.csv", "time[s],p[Pa]\n0,0\n1," + std::to_string(limit + 2 * t) + "\n");
  return {point, {End::done, "", {{{"core_s", 1}, {"ns_per_update", 1 / t}}}, 0, folder.path() / name}};
}

}  // namespace

TEST_CASE("each method may have a reference of its own settings, which it alone is compared with")
{
  const TemporaryFolder folder;
  const Study study = two_methods();
  std::vector<MeasuredPoint> points;
  for (const Point& point : points_of(study)) points.push_back(measured(point, folder));

  const QuantityFindings found = findings_of(study, points).quantities.front();

  REQUIRE(points.size() == 8);
  CHECK(points[2].point.label == "one, t 0.4");
  CHECK(points[5].point.reference_of == "other");
  CHECK(points[5].point.setting("/limit") == 20);
  // 1.6 of 10 and of 20.
  CHECK(found.errors.at(points[0].point.id) == Approx(0.16));
  CHECK(found.errors.at(points[1].point.id) == Approx(0.08));
  CHECK(found.reference.bound);
  CHECK(found.orders.empty());
  CHECK_THAT(found.reference.note, Catch::StartsWith("of each method its own, least certain that of one: "));
}

TEST_CASE("an error budget asks for one reference of all methods")
{
  const TemporaryFolder folder;
  folder.write("path.csv", "time,F11,F12,F13,F21,F22,F23,F31,F32,F33\n0,1,0,0,0,1,0,0,0,1\n1,2,0,0,0,1,0,0,0,1\n");
  folder.write("sand.json", "{}");
  const auto file = folder.write("study.json", R"({
    "measure": { "drive": "sand.json", "path": "path.csv" }, "methods": [{ "name": "one" }],
    "quantities": [{ "name": "p", "column": "p[Pa]" }], "reference": { "of_each_method": true },
    "budget": { "quantities": ["p"], "of": [{ "name": "one" }], "parts": [{ "name": "grid", "to_reference": true }] }
  })");

  CHECK_THROWS_WITH(read_study(file, false),
                    Catch::Contains("#/budget/parts/0/to_reference: true; expected one reference for all methods"));
}

}  // namespace test_own_references
