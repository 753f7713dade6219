#include "tools/study/expectation_results.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/tools/temporary_folder.hpp"

namespace test_gates
{

using namespace tamp;
using namespace tamp::test;
using namespace tamp::tools::study;
using Kind = Expectation::Kind;

namespace
{

/// Result for a method with these errors on cells of 4, 2 and 1; NaN for a run that became unstable.
ExpectationResult judged(const Expectation& expectation, const std::vector<double>& errors)
{
  const TemporaryFolder folder;
  Study study;
  study.refine = "/h";
  Quantity way{"way", Take::last, "way[m]"};
  way.exact = 10;
  study.quantities = {way};
  study.methods = {{"other", "other", false, {}, {{"/h", {8}}}, {}}, {"a", "a", false, {}, {{"/h", {4, 2, 1}}}, {}}};
  study.expectations = {expectation};

  std::vector<MeasuredPoint> measured;
  for (const Point& point : points_of(study)) {
    const double error = point.method == "a" ? errors.at(measured.size() - 1) : 0.5;
    const auto file = folder.write(std::to_string(point.id) + "/history.csv",
                                   "time[s],way[m]\n0," + std::to_string(10 * (1 - error)) + "\n");
    measured.push_back({point, {End::done, "", {{{"core_s", 1}}}, HUGE_VAL, file.parent_path()}});
    if (!std::isnan(error)) continue;
    measured.back().result.end = End::unstable;
    measured.back().result.reason = "the energy is wrong";
  }
  const auto results = judge_expectations(study, measured, findings_of(study, measured));
  REQUIRE(results.size() == 1);
  CHECK(results[0].method == "a");
  CHECK(results[0].why == "theory");
  return results[0];
}

Expectation expecting(Kind kind, double limit)
{
  return {kind, limit, "way", {"a"}, "theory"};
}

ExpectationResult judged(Kind kind, double limit, const std::vector<double>& errors)
{
  return judged(expecting(kind, limit), errors);
}

}  // namespace

TEST_CASE("an expectation that is known to be missed is distinguished from one that is to hold")
{
  Expectation known = expecting(Kind::error_at_most, 0.1);
  known.missed = {{"a", "noise"}, {"other", "more noise"}};

  CHECK(judged(known, {0.4, 0.2, 0.2}).missed == "noise");
  CHECK(verdict(judged(known, {0.4, 0.2, 0.2})) == "missed, as known");
  CHECK(verdict(judged(known, {0.4, 0.2, 0.1})) == "holds, though known to be missed");
  CHECK(verdict(judged(Kind::error_at_most, 0.1, {0.4, 0.2, 0.2})) == "FAILS");
  CHECK(verdict(judged(Kind::error_at_most, 0.1, {0.4, 0.2, 0.1})) == "holds");
}

TEST_CASE("an order is that of the fit through all grids")
{
  // Slope of log2 0.16, 0.08, 0.02 over log2 4, 2, 1: (3 + 0) / 2.
  const std::vector<double> errors{0.16, 0.08, 0.02};

  CHECK(judged(Kind::order_at_least, 1.49, errors).holds);
  CHECK(*judged(Kind::order_at_least, 1.49, errors).found == Approx(1.5).epsilon(1e-3));
  CHECK_FALSE(judged(Kind::order_at_least, 1.51, errors).holds);
  CHECK(judged(Kind::order_at_most, 1.51, errors).holds);
  CHECK_FALSE(judged(Kind::order_at_most, 1.49, errors).holds);
  CHECK(judged(Kind::order_at_least, 1.51, errors).expected == "order at least 1.51");
  CHECK(judged(Kind::order_at_least, 1.51, errors).note == "order 1.50");
}

TEST_CASE("errors that do not fall from each to the next have an order still")
{
  // (0 - 2) / 2
  CHECK(*judged(Kind::order_at_least, 1, {0.02, 0.16, 0.08}).found == Approx(-1).epsilon(1e-3));
}

TEST_CASE("a method with a run that failed has no order")
{
  const ExpectationResult result = judged(Kind::order_at_most, 5, {0.16, 0.04, NAN});

  CHECK_FALSE(result.holds);
  CHECK_FALSE(result.found);
  CHECK(result.note == "no order: h 1: unstable: the energy is wrong");
}

TEST_CASE("an error of 0 gives no order")
{
  CHECK(judged(Kind::order_at_least, 1, {0.16, 0.04, 0}).note == "no order: fewer than three errors above 0");
}

TEST_CASE("the error that is judged is that of the finest grid")
{
  CHECK(judged(Kind::error_at_most, 0.03, {0.16, 0.08, 0.02}).holds);
  CHECK_FALSE(judged(Kind::error_at_most, 0.01, {0.001, 0.001, 0.02}).holds);
  CHECK(judged(Kind::error_at_least, 0.01, {0.001, 0.001, 0.02}).holds);
  CHECK_FALSE(judged(Kind::error_at_least, 0.03, {0.16, 0.08, 0.02}).holds);
  CHECK_FALSE(judged(Kind::error_at_most, 1, {0.16, 0.08, NAN}).holds);
  CHECK(judged(Kind::error_at_most, 0.01, {0.16, 0.08, 0.02}).note == "error 2 %");
  CHECK(judged(Kind::error_at_most, 0.01, {0.16, 0.08, 0.02}).expected == "error at most 1 %");
}

TEST_CASE("the error of another grid is judged where one is named")
{
  Expectation expectation = expecting(Kind::error_at_most, 0.1);
  expectation.at = 2;
  CHECK(judged(expectation, {0.16, 0.08, 0.2}).holds);
  CHECK(judged(expectation, {0.16, 0.08, 0.2}).expected == "error at most 10 % at 2");
  CHECK_FALSE(judged(expectation, {0.05, 0.16, 0.05}).holds);
  expectation.at = 3;
  CHECK_FALSE(judged(expectation, {0.01, 0.01, 0.01}).holds);
  CHECK(judged(expectation, {0.01, 0.01, 0.01}).note == "no point there");
}

TEST_CASE("the limit that is judged is that of a fit by the order expected, errors of either sign")
{
  // Answers of 10 (1 - e) with e = 0.02 + 0.01 h, and with e = h^2 / 100 - 0.01.
  const std::vector<double> first{0.06, 0.04, 0.03}, second{0.15, 0.03, 0};
  Expectation expectation = expecting(Kind::limit_error_at_most, 0.021);
  CHECK(judged(expectation, first).holds);
  CHECK(*judged(expectation, first).found == Approx(0.02));
  CHECK(judged(expectation, first).expected == "error of the limit by order 1 at most 2.1 %");
  expectation.limit = 0.019;
  CHECK_FALSE(judged(expectation, first).holds);
  expectation.limit_order = 2;
  CHECK(*judged(expectation, second).found == Approx(0.01));
  CHECK(judged(expectation, second).holds);
  CHECK(judged(expectation, {0.06, NAN, 0.03}).note == "no limit: h 2: unstable: the energy is wrong");
}

TEST_CASE("a method fails that becomes unstable, or whose error is half as large again on the finest grid as its least")
{
  CHECK(judged(Kind::fails, 0, {NAN, 0.08, 0.02}).holds);
  CHECK(judged(Kind::fails, 0, {0.16, 0.02, 0.031}).holds);
  CHECK_FALSE(judged(Kind::fails, 0, {0.16, 0.02, 0.029}).holds);
  CHECK(judged(Kind::fails, 0, {0.02, 0.16, 0.08}).holds);
  CHECK_FALSE(judged(Kind::fails, 0, {0.16, 0.08, 0.08}).holds);
  CHECK(judged(Kind::fails, 0, {0.16, 0.08, 0.04}).note == "error on the finest grid 4 %, at least 4 %");
}

TEST_CASE("a run that failed on a grid that is not judged leaves an error its bar")
{
  CHECK(judged(Kind::error_at_most, 0.03, {NAN, 0.08, 0.02}).holds);
  CHECK_FALSE(judged(Kind::limit_error_at_most, 0.03, {NAN, 0.08, 0.02}).holds);
}

TEST_CASE("a study that refines nothing has each point judged by itself")
{
  const TemporaryFolder folder;
  Study study;
  Quantity way{"way", Take::last, "way[m]"};
  way.exact = 1;
  study.quantities = {way};
  study.methods = {{"a", "a", false, {}, {{"/k", {1, 2}}}, {}}};
  study.expectations = {{Kind::error_at_most, 0.1, "way", {"a"}, ""}};
  std::vector<MeasuredPoint> measured;
  for (const Point& point : points_of(study)) {
    const auto file =
        folder.write(std::to_string(point.id) + "/history.csv", point.id == 1 ? "way[m]\n1\n" : "way[m]\n2\n");
    measured.push_back({point, {End::done, "", {{{"core_s", 1}}}, HUGE_VAL, file.parent_path()}});
  }

  const auto results = judge_expectations(study, measured, findings_of(study, measured));

  REQUIRE(results.size() == 2);
  CHECK(results[0].holds);
  CHECK_FALSE(results[1].holds);
  CHECK(results[1].label == "a, k 2");
}

}  // namespace test_gates
