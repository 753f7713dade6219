#include "tools/study/limit/limit_search.hpp"

#include <catch2/catch.hpp>
#include <cmath>

namespace test_limit_search
{

using namespace tamp::tools::study;
using Verdict = Probe::Verdict;

namespace
{

/// Stable up to a value, which is stable itself.
auto stable_up_to(double limit)
{
  return [=](double value) { return Probe{value, value <= limit ? Verdict::stable : Verdict::unstable, "too long"}; };
}

}  // namespace

TEST_CASE("a limit above the value as written is found by doubling, then in equal ratios")
{
  const Limit limit = search_limit("flip", 0.8, {}, stable_up_to(3));

  REQUIRE(limit.edge);
  CHECK(limit.edge->stable.value <= 3);
  CHECK(limit.edge->unstable.value > 3);
  CHECK(limit.edge->unstable.value <= 1.02 * limit.edge->stable.value);
  CHECK(limit.edge->unstable.why == "too long");
  CHECK(limit.probes[0].value == 0.8);
  CHECK(limit.probes[1].value == 1.6);
  CHECK(limit.probes[2].value == 3.2);
  CHECK(limit.probes[3].value == Approx(std::sqrt(1.6 * 3.2)).epsilon(1e-5));
  CHECK(limit.note.empty());
}

TEST_CASE("a value as written that is not stable is halved until it is")
{
  const Limit limit = search_limit("flip", 0.8, {}, stable_up_to(0.15));

  REQUIRE(limit.edge);
  CHECK(limit.probes[3].value == 0.1);
  CHECK(limit.edge->stable.value <= 0.15);
  CHECK(limit.edge->stable.value >= 0.15 / 1.02);
}

TEST_CASE("the limit may be a least value that is stable")
{
  const auto stable_from = [](double value) {
    return Probe{value, value >= 0.3 ? Verdict::stable : Verdict::unstable};
  };

  const Limit limit = search_limit("viscosity", 1, {{{0.01, 2}}}, stable_from);

  REQUIRE(limit.edge);
  CHECK(limit.edge->stable.value >= 0.3);
  CHECK(limit.edge->unstable.value < 0.3);
  CHECK(limit.edge->stable.value <= 1.02 * limit.edge->unstable.value);
}

TEST_CASE("what is stable at both ends has no limit between them, and what is at neither")
{
  const Limit stable = search_limit("flip", 0.5, {{{0.1, 1}}}, stable_up_to(2));
  const Limit unstable = search_limit("flip", 0.5, {{{0.1, 1}}}, stable_up_to(0.01));

  CHECK_FALSE(stable.edge);
  CHECK(stable.note == "stable at all 3 values from 0.1 to 1");
  CHECK_FALSE(unstable.edge);
  CHECK(unstable.note == "unstable at all 3 values from 0.1 to 1");
}

TEST_CASE("no more runs are made than are allowed, and the edge is as narrow as they made it")
{
  const Limit limit = search_limit("flip", 1, {std::nullopt, 0.02, 4}, stable_up_to(3));

  CHECK(limit.probes.size() == 4);
  REQUIRE(limit.edge);
  CHECK(limit.edge->stable.value == Approx(std::sqrt(8)).epsilon(1e-5));
  CHECK(limit.edge->unstable.value == 4);
  CHECK(search_limit("flip", 1, {std::nullopt, 0.02, 3}, stable_up_to(100)).probes.size() == 3);
}

TEST_CASE("a value in the middle that is refused ends the search, with the edge as wide as it is")
{
  const auto halves_only = [](double value) {
    return Probe{value, value == 1 ? Verdict::stable : value == 2 ? Verdict::unstable : Verdict::no_answer};
  };

  const Limit limit = search_limit("cells", 1, {}, halves_only);

  CHECK(limit.probes.size() == 3);
  REQUIRE(limit.edge);
  CHECK(limit.edge->stable.value == 1);
  CHECK(limit.edge->unstable.value == 2);
}

TEST_CASE("a value that is refused ends the search for one that is not stable")
{
  const auto refused_from_one = [](double value) {
    return Probe{value, value > 1 ? Verdict::no_answer : Verdict::stable, "expected at most 1"};
  };

  const Limit limit = search_limit("flip", 0.8, {}, refused_from_one);

  CHECK_FALSE(limit.edge);
  CHECK(limit.probes.size() == 2);
  CHECK(limit.note == "stable; 1.6 has no answer: expected at most 1");
}

TEST_CASE("of several edges the one nearest to the value as written is the limit")
{
  // Stable below 0.5, and by chance from 2 to 4 again.
  const auto in_two_ranges = [](double value) {
    return Probe{value, value <= 0.5 || (value >= 2 && value <= 4) ? Verdict::stable : Verdict::unstable};
  };

  const Limit limit = search_limit("flip", 0.4, {{{1, 3}}}, in_two_ranges);

  REQUIRE(limit.edge);
  CHECK(limit.edge->stable.value <= 0.5);
  CHECK(limit.edge->unstable.value > 0.5);
  CHECK(limit.edge->unstable.value < 0.6);
}

}  // namespace test_limit_search
