#include "tools/study/points.hpp"

#include <catch2/catch.hpp>

namespace test_points
{

using namespace tamp;
using namespace tamp::tools::study;
using tools::Json;

namespace
{

Study two_methods()
{
  Study study;
  study.settings = {{"/time/end", 1}};
  const std::vector<Axis> sweep{{"/grid/cell_size", {4, 2}}, {"/transfer", {"flip", "tflip"}}};
  study.methods = {{"a", "contact", false, {}, sweep, {}},
                   {"b", "contact", false, {{"/time/end", 2}}, {}, {{{"/grid/cell_size", 1}}}}};
  return study;
}

}  // namespace

TEST_CASE("a method has all combinations of its sweep, and the points that are listed for it")
{
  const std::vector<Point> points = points_of(two_methods());

  REQUIRE(points.size() == 5);
  CHECK(points[0].settings == Settings{{"/time/end", 1}, {"/grid/cell_size", 4}, {"/transfer", "flip"}});
  CHECK(points[1].settings == Settings{{"/time/end", 1}, {"/grid/cell_size", 4}, {"/transfer", "tflip"}});
  CHECK(points[3].settings == Settings{{"/time/end", 1}, {"/grid/cell_size", 2}, {"/transfer", "tflip"}});
  CHECK(points[3].label == "cell size 2, transfer tflip");
  CHECK(points[4].method == "b");
  CHECK(points[4].settings == Settings{{"/time/end", 2}, {"/grid/cell_size", 1}});
  CHECK(points[4].id == 5);
}

TEST_CASE("a method without a sweep is one point")
{
  Study study = two_methods();
  study.methods.back().listed.clear();
  CHECK(points_of(study).size() == 5);
  CHECK(points_of(study).back().settings == Settings{{"/time/end", 2}});
}

TEST_CASE("references and error budgets add their own points")
{
  Study study = two_methods();
  study.methods.resize(1);
  study.reference = ReferenceRuns{{{"/transfer", "tflip"}}, {"/grid/cell_size", {4, 2, 1}}};
  study.budget = Budget{{"depth"}, {{"base", {{"/grid/cell_size", 2}}}}, {{"grid", true, {}}, {"step", false, {}}}};
  study.budget->parts[1].variations = {{{"/time/multiplier", 0.5}}, {{"/time/multiplier", 0.25}}};

  const std::vector<Point> points = points_of(study);

  REQUIRE(points.size() == 4 + 3 + 3);
  CHECK(points[6].role == Point::Role::reference);
  CHECK(points[6].setting("/grid/cell_size") == 1);
  CHECK(points[7].role == Point::Role::variation);
  CHECK(points[9].settings == Settings{{"/time/end", 1}, {"/grid/cell_size", 2}, {"/time/multiplier", 0.25}});
  CHECK(points[9].setting("/nothing").is_null());
}

}  // namespace test_points
