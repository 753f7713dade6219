#include "tools/study/findings.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/problems.hpp"

namespace test_findings
{

using namespace tamp;
using namespace tamp::test;
using namespace tamp::tools::study;

namespace
{

/// A study whose points have answered by hand-written files.
class AnsweredStudy
{
 public:
  AnsweredStudy()
  {
    study.refine = "/h";
    study.quantities = {{"depth", Take::greatest, "depth[m]"}};
    study.methods = {{"a", "a", false, {}, {{"/h", {4, 2, 1}}}, {}}};
  }

  /// As many depths as points of the study, each reached after 1 s of three, and what each point costs [s].
  Findings findings(const std::vector<double>& depths, const std::vector<double>& costs)
  {
    const std::vector<Point> points = points_of(study);
    REQUIRE(points.size() == depths.size());
    std::vector<MeasuredPoint> measured;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const auto file = folder_.write(std::to_string(i) + "/history.csv",
                                      "time[s],depth[m]\n0,0\n1," + std::to_string(depths[i]) + "\n3,0\n");
      PointResult result{End::done, "", {{{"core_s", costs[i]}}}, HUGE_VAL, file.parent_path()};
      if (std::isnan(depths[i])) result.end = End::unstable;
      for (const MeasuredPoint& earlier : measured) {
        if (share_results && earlier.point.settings == points[i].settings) result.folder = earlier.result.folder;
      }
      measured.push_back({points[i], result});
    }
    return findings_of(study, measured);
  }

  Study study;
  /// As the cache does it: points with the same settings have the same result.
  bool share_results = false;

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("errors are those against the limit of the finest runs")
{
  AnsweredStudy answered;
  answered.study.reference = ReferenceRuns{{}, {"/h", {4, 2, 1}}};

  // Depth 1 - 0.01 h^2: the limit is 1.
  const std::vector<double> depths{0.84, 0.96, 0.99, 0.84, 0.96, 0.99};
  const QuantityFindings found = answered.findings(depths, {1, 8, 64, 1, 8, 64}).quantities[0];

  CHECK(found.reference.kind == Reference::Kind::extrapolated);
  CHECK(found.reference.answer.value == Approx(1).epsilon(1e-9));
  CHECK(*found.reference.uncertainty == Approx(0.0125).epsilon(1e-6));
  CHECK(found.errors.at(1) == Approx(0.16));
  CHECK(found.errors.at(3) == Approx(0.01));
  CHECK(found.front == std::vector<int>{1, 2, 3});
  CHECK(*found.orders[0].order == Approx(2));
  CHECK(*found.orders[0].cost_power == Approx(-3));
}

TEST_CASE("a reference is known no better than other forms agree with it")
{
  AnsweredStudy answered;
  answered.study.methods[0].sweep[0].values = {4};
  answered.study.reference = ReferenceRuns{{}, {"/h", {4, 2, 1}}, false, {{{"/form", "a"}}, {{"/form", "b"}}}};

  // The limit is 1, known to 0.0125; the other forms on the finest grid are 0.005 and 0.04 from it.
  const QuantityFindings found =
      answered.findings({0.84, 0.84, 0.96, 0.99, 0.995, 1.04}, {1, 1, 1, 1, 1, 1}).quantities[0];

  CHECK(*found.reference.uncertainty == Approx(0.04));
  CHECK_THAT(found.reference.note, Catch::EndsWith("other forms are up to 4 % from it (form b)"));
}

TEST_CASE("runs whose differences do not fall bound nothing")
{
  AnsweredStudy answered;
  answered.study.reference = ReferenceRuns{{}, {"/h", {4, 2, 1}}};

  const QuantityFindings found = answered.findings({1.0, 1.1, 1.3, 1.0, 1.1, 1.3}, {1, 2, 3, 1, 2, 3}).quantities[0];

  CHECK(found.reference.kind == Reference::Kind::finest);
  CHECK_FALSE(found.reference.bound);
  CHECK_FALSE(found.reference.uncertainty);
  CHECK(found.reference.note.starts_with("no bound"));
  CHECK(found.errors.at(1) == Approx(0.3 / 1.3));
  CHECK(found.differences == std::set<int>{1, 2, 3, 4, 5});
  CHECK(found.front.empty());
}

TEST_CASE("differences from one run are no errors, have no order and are on no front")
{
  AnsweredStudy answered;
  answered.study.methods[0].sweep[0].values = {4, 2, 1};
  answered.study.reference = ReferenceRuns{{{"/h", 1}, {"/model", "table"}}, {}};

  // As if of second order, towards a run that is as far from the truth as nobody knows.
  const QuantityFindings found = answered.findings({0.84, 0.96, 0.99, 1}, {1, 8, 64, 64}).quantities[0];

  CHECK(found.errors.at(1) == Approx(0.16));
  CHECK(found.differences == std::set<int>{1, 2, 3});
  CHECK(found.front.empty());
  REQUIRE(found.orders.size() == 1);
  CHECK_FALSE(found.orders[0].order);
  CHECK(found.orders[0].note == "no order: differences, which are no errors");
  CHECK(*found.orders[0].cost_power == Approx(-3));
}

TEST_CASE("another model than the reference's differs from it, and has errors only where the answer is exact")
{
  AnsweredStudy answered;
  answered.study.methods.push_back(answered.study.methods[0]);
  answered.study.methods[1].name = "b";
  answered.study.methods[1].another_model = true;
  answered.study.reference = ReferenceRuns{{}, {"/h", {4, 2, 1}}};
  const std::vector<double> depths{0.84, 0.96, 0.99, 0.85, 0.97, 0.999, 0.84, 0.96, 0.99};
  const std::vector<double> costs{1, 8, 64, 0.5, 4, 32, 1, 8, 64};

  const QuantityFindings of_runs = answered.findings(depths, costs).quantities[0];
  answered.study.quantities[0].exact = 1;
  const QuantityFindings exact = answered.findings(depths, costs).quantities[0];

  CHECK(of_runs.differences == std::set<int>{4, 5, 6});
  CHECK(of_runs.front == std::vector<int>{1, 2, 3});
  CHECK(*of_runs.orders[0].order == Approx(2));
  CHECK_FALSE(of_runs.orders[1].order);
  CHECK(exact.differences.empty());
  CHECK(exact.front == std::vector<int>{4, 5, 6});
}

TEST_CASE("a run that is the reference has no error, whatever else it is called")
{
  AnsweredStudy answered;
  answered.study.reference = ReferenceRuns{{{"/h", 1}}, {}};
  answered.share_results = true;

  const QuantityFindings found = answered.findings({1, 1.1, 1.2, 1.2}, {1, 2, 3, 3}).quantities[0];

  CHECK(found.errors.size() == 2);
  CHECK_FALSE(found.errors.contains(3));
  CHECK(found.reference.kind == Reference::Kind::run);
}

TEST_CASE("a reference that is not done is none, and failed points have no error")
{
  AnsweredStudy answered;
  answered.study.reference = ReferenceRuns{{}, {"/h", {4, 2, 1}}};

  const QuantityFindings found = answered.findings({1, 1, NAN, 1, 1, NAN}, {1, 2, 3, 1, 2, 3}).quantities[0];

  CHECK(found.reference.kind == Reference::Kind::none);
  CHECK_THAT(found.reference.note, Catch::StartsWith("no reference: the run with h 1 ended with unstable"));
  CHECK(found.errors.empty());
  CHECK(found.values.size() == 4);
}

TEST_CASE("the front has the points than which none is cheaper and better")
{
  AnsweredStudy answered;
  answered.study.quantities[0].exact = 1;
  answered.study.methods[0].sweep[0].values = {1, 2, 3, 4, 5};

  const QuantityFindings found = answered.findings({0.8, 0.7, 0.9, 0.9, 1}, {1, 2, 3, 4, 5}).quantities[0];

  CHECK(found.front == std::vector<int>{1, 3, 5});
  CHECK(found.reference.kind == Reference::Kind::exact);
}

TEST_CASE("an order does not depend on how the sweep is listed")
{
  AnsweredStudy answered;
  answered.study.quantities[0].exact = 1;
  answered.study.methods[0].sweep[0].values = {1, 4, 2};

  const OrderFit fit = answered.findings({0.99, 0.84, 0.96}, {64, 1, 8}).quantities[0].orders[0];

  CHECK(fit.points == std::vector<int>{2, 3, 1});
  CHECK(*fit.order == Approx(2));
  CHECK(*fit.cost_power == Approx(-3));
}

TEST_CASE("a part of an error budget with a run that failed has no bound")
{
  AnsweredStudy answered;
  answered.study.methods[0].sweep.clear();
  answered.study.budget = Budget{{"depth"}, {{"base", {}}}, {{"step", false, {{{"/m", 0.5}}, {{"/m", 0.25}}}}}};

  const Findings found = answered.findings({0.96, 0.96, 0.97, NAN}, {1, 1, 1, 1});

  CHECK_FALSE(found.budgets.at(0).parts[0].amount);
  CHECK_THAT(found.budgets.at(0).parts[0].note, Catch::Contains("m 0.25: not known"));
}

TEST_CASE("an error budget has the greatest change of each part, and the distance from the reference")
{
  AnsweredStudy answered;
  answered.study.methods[0].sweep.clear();
  answered.study.methods[0].settings = {{"/h", 2}};
  answered.study.reference = ReferenceRuns{{}, {"/h", {4, 2, 1}}};
  answered.study.budget = Budget{{"depth"}, {{"base", {{"/h", 2}}}}, {}};
  answered.study.budget->parts = {{"grid", true, {}}, {"step", false, {{{"/m", 0.5}}, {{"/m", 0.25}}}}};

  // The method's point; the reference's three; the base and its two variations.
  const Findings found = answered.findings({0.96, 0.84, 0.96, 0.99, 0.96, 0.936, 0.9696}, {1, 1, 1, 1, 1, 1, 1});

  const ErrorBudget& budget = found.budgets.at(0);
  CHECK(*budget.value == Approx(0.96));
  CHECK(*budget.parts[0].amount == Approx(0.04 + 0.0125).epsilon(1e-6));
  CHECK(*budget.parts[1].amount == Approx(0.025));
  CHECK_THAT(budget.parts[1].note, Catch::Contains("m 0.5: -2.5 %") && Catch::Contains("m 0.25: +1 %"));
}

}  // namespace test_findings
