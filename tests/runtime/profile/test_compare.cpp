#include "runtime/profile/compare.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "runtime/profile/over_time.hpp"

namespace tamp::runtime::test_compare
{

namespace
{

using Parts = std::vector<double>;

nlohmann::json profile(double steps_each, const Parts& step, const std::vector<std::pair<std::string, Parts>>& tasks)
{
  nlohmann::json list = nlohmann::json::array();
  for (const auto& [name, parts] : tasks) list.push_back({{"name", name}, {"over_time_s", parts}});
  return {{"over_time", {{"steps_each", steps_each}, {"step_s", step}}}, {"tasks", list}};
}

/// A cost that doubles as a run goes on, with noise of 10 %, times a factor.
Parts growing(std::size_t n, double factor, unsigned seed)
{
  std::mt19937_64 random(seed);
  Parts parts(n);
  for (std::size_t k = 0; k < n; ++k) {
    const double noise = 0.9 + 0.2 * static_cast<double>(random()) / 18446744073709551616.0;
    parts[k] = factor * noise * (1 + static_cast<double>(k) / static_cast<double>(n));
  }
  return parts;
}

const TaskComparison& named(const std::vector<TaskComparison>& all, const std::string& name)
{
  return *std::find_if(all.begin(), all.end(), [&](const TaskComparison& task) { return task.name == name; });
}

}  // namespace

TEST_CASE("parts of a run are joined in pairs as it grows, and sums stay", "[profile]")
{
  RunParts parts;
  TicksOverTime ticks;
  for (long step = 0; step < 300; ++step) {
    if (parts.outgrown_by(step)) {
      parts.join_pairs();
      ticks.join_pairs();
    }
    ticks.of_part[parts.part_of(step)] += 10;
  }

  CHECK(parts.steps_each() == 8);
  const std::vector<long> steps = parts.steps_of_parts(300);
  REQUIRE(steps.size() == 38);
  for (std::size_t k = 0; k < steps.size(); ++k) {
    CHECK(steps[k] == (k == 37 ? 4 : 8));
    CHECK(ticks.of_part[k] == 10 * static_cast<std::uint64_t>(steps[k]));
  }
  CHECK(ticks.of_part[38] == 0);
}

TEST_CASE("a task that takes a fifth longer is told from noise, although costs double in a run", "[profile]")
{
  const auto here = profile(4, growing(40, 3, 1), {{"slower", growing(40, 1, 2)}, {"the same", growing(40, 2, 3)}});
  const auto there =
      profile(4, growing(40, 3.2, 4), {{"slower", growing(40, 1.2, 5)}, {"the same", growing(40, 2, 6)}});

  const auto all = compare_profiles(here, there);

  CHECK(all[0].name == "a step");
  const TaskComparison &slower = named(all, "slower"), &same = named(all, "the same");
  CHECK(slower.differs());
  CHECK(slower.ratio == Approx(1.2).epsilon(0.05));
  CHECK(slower.error < 0.05);
  CHECK(*slower.here_s == Approx(1.5).epsilon(0.05));
  CHECK_FALSE(same.differs());
}

TEST_CASE("runs whose parts differ in length are compared over the steps that both have", "[profile]")
{
  // Ten seconds a step in the first 40 steps, then one.
  Parts fine(40, 10), coarse(20, 20);
  fine.resize(64, 1);

  const auto all = compare_profiles(profile(1, fine, {{"task", fine}}), profile(4, coarse, {{"task", coarse}}));

  CHECK(named(all, "task").here_s == 10);
  CHECK(named(all, "task").there_s == 20);
  CHECK(named(all, "task").ratio == Approx(2));
}

TEST_CASE("a task that most parts do without is compared in the others", "[profile]")
{
  Parts late(30, 0);
  std::fill(late.begin() + 20, late.end(), 3);
  Parts twice = late;
  std::fill(twice.begin() + 20, twice.end(), 6);
  const Parts step(30, 10);

  const auto all = compare_profiles(profile(1, step, {{"contact", late}}), profile(1, step, {{"contact", twice}}));

  CHECK(*named(all, "contact").here_s == Approx(1));
  CHECK(*named(all, "contact").there_s == Approx(2));
  CHECK(named(all, "contact").ratio == Approx(2));
}

TEST_CASE("runs that have no whole part in common have their own numbers, and no ratio", "[profile]")
{
  const Parts brief(10, 1), lengthy(60, 2);

  const auto all = compare_profiles(profile(1, brief, {{"task", brief}}), profile(64, lengthy, {{"task", lengthy}}));

  for (const TaskComparison& task : all) {
    CHECK(task.here_s == 1);
    CHECK(task.there_s == 2);
    CHECK(task.ratio == 0);
  }
}

TEST_CASE("tasks of one run alone, and runs that are too short, are named", "[profile]")
{
  const Parts few(5, 1), some(8, 1);
  const auto all = compare_profiles(profile(1, some, {{"old", some}}), profile(1, some, {{"new", some}}));
  const auto brief = compare_profiles(profile(1, few, {{"task", few}}), profile(1, few, {{"task", few}}));

  CHECK_THAT(to_text(all), Catch::Contains("only here") && Catch::Contains("only there"));
  CHECK_FALSE(named(all, "old").there_s.has_value());
  CHECK_FALSE(named(all, "new").here_s.has_value());
  CHECK(named(brief, "task").ratio == 0);
  CHECK_THAT(to_text(brief), Catch::Contains("too short to tell"));
}

}  // namespace tamp::runtime::test_compare
