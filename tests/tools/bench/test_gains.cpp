#include <algorithm>
#include <catch2/catch.hpp>
#include <chrono>
#include <nlohmann/json.hpp>

#include "runtime/engine.hpp"
#include "tests/tools/program.hpp"
#include "tools/bench/slow_task.hpp"

namespace test_gains
{

using namespace tamp;
using namespace tamp::test;

namespace
{

const runtime::CellLabel<double, "first"> first;
const runtime::CellLabel<double, "second"> second;

void work()
{
  const auto end = std::chrono::steady_clock::now() + std::chrono::microseconds(50);
  while (std::chrono::steady_clock::now() < end) continue;
}

/// Two tasks, one after the other, that take as long.
runtime::TaskList pair_of_tasks()
{
  return {runtime::task("first").over_patches().computes(first).body([](const runtime::TaskContext&, auto) { work(); }),
          runtime::task("second").over_patches().reads(first).computes(second).body(
              [](const runtime::TaskContext&, auto) { work(); })};
}

/// The least that a task takes, which others on the machine do not change.
double least_s(const runtime::Profile& profile, const std::string& task)
{
  return std::ranges::find(profile.tasks, task, &runtime::TaskStatistics::name)->min_s;
}

runtime::Profile profile_of(runtime::TaskList step)
{
  runtime::Executor executor(1);
  const runtime::PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {2, 1, 1});
  runtime::Engine engine(layout, {"all"}, {{std::move(step), {{}, {&second}}}}, executor);
  for (int n = 0; n < 50; ++n) engine.advance(1);
  return engine.profile();
}

}  // namespace

TEST_CASE("a task that is slowed down takes as much longer as it is told, and no other one does")
{
  runtime::TaskList slowed = pair_of_tasks();

  REQUIRE(tools::bench::slow_down(slowed, "first", 2));
  const runtime::Profile plain = profile_of(pair_of_tasks()), profile = profile_of(std::move(slowed));

  CHECK(least_s(profile, "first") == Approx(2 * least_s(plain, "first")).epsilon(0.1));
  CHECK(least_s(profile, "second") == Approx(least_s(plain, "second")).epsilon(0.1));
}

TEST_CASE("a task that a step has not cannot be slowed down")
{
  runtime::TaskList step = pair_of_tasks();

  CHECK_FALSE(tools::bench::slow_down(step, "third", 2));
}

TEST_CASE("the benchmark of gains has for each task what was forecast beside what was measured")
{
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "gains.json").string();

  const Outcome outcome = tamp_with("bench gains --steps 60 --rounds 1 --task 'update stress: sand' --json " + file);

  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(file)).at("gains");
  REQUIRE(json.at("tasks").size() == 1);
  const auto& task = json.at("tasks").at(0);
  CHECK(task.at("task") == "update stress: sand");
  CHECK(task.at("replayed_us") > json.at("step_us"));
  CHECK(task.at("measured_us") > 0.0);
  CHECK_THAT(outcome.out, Catch::Contains("update stress: sand") && Catch::Contains("difference"));
}

TEST_CASE("the benchmark of gains runs on as many threads as it is told")
{
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "gains.json").string();

  const Outcome outcome = tamp_with("bench gains --threads 1 --steps 20 --rounds 1 --json " + file);

  REQUIRE(outcome.exit_code == 0);
  CHECK(nlohmann::json::parse(read_text(file)).at("gains").at("threads") == 1);
  CHECK_THAT(outcome.out, Catch::Contains("20 steps on 1 thread,"));
}

TEST_CASE("what no benchmark that is asked for looks at is refused with those that do")
{
  const auto refused = [](const std::string& arguments, const std::string& words) {
    const Outcome outcome = tamp_with("bench " + arguments);
    CHECK(outcome.exit_code == 2);
    CHECK(outcome.err == "tamp: " + words + "\n");
  };

  refused("gains --threads 1,2 --rounds 1",
          "--threads: 1,2 of gains; expected one number, or several with the benchmark tasks alone");
  refused("moduli --threads 2", "--threads: not of moduli; expected it with tasks or gains");
  refused("peers --task 'update stress: sand'", "--task: not of peers; expected it with gains");
  refused("tasks --particles 400", "--particles: not of tasks; expected it with peers");
}

TEST_CASE("the benchmark of gains finds tasks on the longest chain and beside it in any scene", "[slow]")
{
  const TemporaryFolder folder;
  const std::string file = (folder.path() / "gains.json").string();
  std::string scene = read_text(TAMP_SOURCE_DIR "/inputs/punch/quick.json");
  for (std::size_t at = scene.find("\"sand\""); at != std::string::npos; at = scene.find("\"sand\"")) {
    scene.replace(at, 6, "\"soil\"");
  }
  const std::string above = "../materials";
  scene.replace(scene.find(above), above.size(), TAMP_SOURCE_DIR "/inputs/materials");
  const std::string other = folder.write("soil.json", scene).string();

  const Outcome outcome = tamp_with("bench gains --steps 20 --rounds 1 --scene " + other + " --json " + file);

  INFO(outcome.err);
  REQUIRE(outcome.exit_code == 0);
  const auto json = nlohmann::json::parse(read_text(file)).at("gains");
  REQUIRE(json.at("tasks").size() == 2);
  CHECK(json.at("tasks").at(0).at("task") == "update stress: soil");
}

TEST_CASE("the benchmark of gains names the tasks of a step where one is asked for that it has not")
{
  const Outcome outcome = tamp_with("bench gains --rounds 1 --task stress");

  CHECK(outcome.exit_code == 2);
  CHECK_THAT(outcome.err, Catch::Contains("--task") && Catch::Contains("accelerate nodes"));
}

}  // namespace test_gains
