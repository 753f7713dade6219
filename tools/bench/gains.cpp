#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <chrono>
#include <memory>

#include "tasks/simulation.hpp"
#include "tools/bench/bench.hpp"
#include "tools/bench/slow_task.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

constexpr double slower = 1.5;
/// Simulations take turns after so many steps: some hundredths of a second.
constexpr long steps_of_turn = 50;

/// A task, and steps of each round in which it is slower [s].
struct SlowedTask {
  std::string name;
  double share = 0;
  double on_chain = 0;
  /// Times of a step with the slower task [s], by round: by replay of the run as it is, extrapolated from the gain of a
  /// tenth, and measured.
  std::vector<double> replayed{}, extrapolated{}, measured{};
  /// Measured over replayed time, by round.
  std::vector<double> ratio{};
};

std::vector<std::string> names_of(const runtime::TaskList& step)
{
  std::vector<std::string> names;
  names.reserve(step.size());
  for (const runtime::TaskDeclaration& task : step) names.push_back(task.name);
  return names;
}

std::unique_ptr<tasks::Simulation> with_slower(const tasks::Scene& scene, const std::string& task,
                                               const std::shared_ptr<runtime::Executor>& executor)
{
  return tasks::Simulation::make(scene, executor, {}, [&](runtime::TaskList& step) {
    if (!slow_down(step, task, slower)) {
      throw InputError({"--task", task, fmt::format("expected one of {}", fmt::join(names_of(step), ", "))});
    }
  });
}

/// The dearest task that `is_wanted`; none where there is no such task.
template <class Wanted>
std::vector<std::string> dearest(const std::vector<runtime::TaskStatistics>& tasks, const Wanted& is_wanted)
{
  const runtime::TaskStatistics* found = nullptr;
  for (const runtime::TaskStatistics& task : tasks) {
    if (is_wanted(task) && (!found || task.share > found->share)) found = &task;
  }
  return found ? std::vector{found->name} : std::vector<std::string>{};
}

/// The dearest on the longest chain of most steps, and the dearest that hardly ever is on it.
std::vector<std::string> typical_tasks(const tasks::Scene& scene, int n_threads)
{
  std::vector<std::string> known;
  const auto executor = std::make_shared<runtime::Executor>(n_threads);
  const auto run =
      tasks::Simulation::make(scene, executor, {}, [&](runtime::TaskList& step) { known = names_of(step); });
  while (run->n_steps() < 4 * steps_of_turn && run->time() < scene.time.end) run->advance(scene.time.end);
  std::vector<runtime::TaskStatistics> all = run->engine().profile().tasks;
  // Only tasks of the scene count, none of the runtime's own.
  std::erase_if(all, [&](const auto& task) { return std::ranges::find(known, task.name) == known.end(); });
  std::vector<std::string> found = dearest(all, [](const auto& task) { return task.on_chain > 0.5; });
  for (const std::string& name : dearest(all, [](const auto& task) { return task.on_chain < 0.1; })) {
    found.push_back(name);
  }
  return found.empty() ? dearest(all, [](const auto&) { return true; }) : found;
}

/// A run as it is and one for each task that is slower, in turns.
class GainBenchmark
{
 public:
  explicit GainBenchmark(const GainOptions& options) : options_(options), scene_(read_scene(options.scene).scene)
  {
    const std::vector<std::string> names =
        options.tasks.empty() ? typical_tasks(scene_, options.n_threads) : options.tasks;
    tasks_.reserve(names.size());
    for (const std::string& task : names) tasks_.push_back({task});
  }

  Result result()
  {
    for (int round = 0; round < options_.n_rounds; ++round) run_round();
    return {json(), text()};
  }

 private:
  void run_round()
  {
    const auto executor = std::make_shared<runtime::Executor>(options_.n_threads);
    const auto as_it_is = tasks::Simulation::make(scene_, executor);
    std::vector<std::unique_ptr<tasks::Simulation>> with_slower_task;
    with_slower_task.reserve(tasks_.size());
    for (const SlowedTask& task : tasks_) with_slower_task.push_back(with_slower(scene_, task.name, executor));
    const double start = process_seconds();
    const auto wall_start = std::chrono::steady_clock::now();
    for (long step = 0; step < options_.n_steps; step += steps_of_turn) {
      take_turn(*as_it_is);
      for (const auto& simulation : with_slower_task) take_turn(*simulation);
    }
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_start;
    core_share_.push_back((process_seconds() - start) / (options_.n_threads * wall.count()));
    for (std::size_t k = 0; k < tasks_.size(); ++k) note(tasks_[k], *as_it_is, *with_slower_task[k]);
    steps_.push_back(as_it_is->engine().profile().step_s);
  }

  void take_turn(tasks::Simulation& simulation) const
  {
    const long last = std::min(simulation.n_steps() + steps_of_turn, options_.n_steps);
    while (simulation.n_steps() < last && simulation.time() < scene_.time.end) simulation.advance(scene_.time.end);
  }

  static void note(SlowedTask& task, const tasks::Simulation& as_it_is, const tasks::Simulation& with_slower_task)
  {
    constexpr double tenth = 0.1;
    const runtime::Engine& engine = as_it_is.engine();
    const runtime::Profile profile = engine.profile();
    const auto row = std::ranges::find(profile.tasks, task.name, &runtime::TaskStatistics::name);
    if (row != profile.tasks.end()) {
      task.share = row->share;
      task.on_chain = row->on_chain;
    }
    const double gain_of_tenth = 1 - engine.step_ratio(task.name, 1 - tenth);
    task.extrapolated.push_back(profile.step_s * (1 + gain_of_tenth * (slower - 1) / tenth));
    task.replayed.push_back(profile.step_s * engine.step_ratio(task.name, slower));
    task.measured.push_back(with_slower_task.engine().profile().step_s);
    task.ratio.push_back(task.measured.back() / task.replayed.back());
  }

  /// Whether other programs had the cores for so long that the workers waited for these, which no replay knows.
  bool is_too_busy() const { return runtime::is_too_busy(median(core_share_)); }

  nlohmann::ordered_json json() const
  {
    nlohmann::ordered_json all{{"scene", options_.scene.filename().string()},
                               {"rounds", options_.n_rounds},
                               {"steps", options_.n_steps},
                               {"threads", options_.n_threads},
                               {"slower", slower},
                               {"step_us", median(steps_) * 1e6},
                               {"core_share", median(core_share_)},
                               {"too_busy", is_too_busy()},
                               {"tasks", nlohmann::ordered_json::array()}};
    for (const SlowedTask& task : tasks_) {
      all["tasks"].push_back({{"task", task.name},
                              {"share", task.share},
                              {"on_chain", task.on_chain},
                              {"replayed_us", median(task.replayed) * 1e6},
                              {"extrapolated_us", median(task.extrapolated) * 1e6},
                              {"measured_us", median(task.measured) * 1e6},
                              {"difference", median(task.ratio) - 1}});
    }
    return all;
  }

  std::string text() const
  {
    std::string text = fmt::format(
        "gains: {}, {} steps on {}, one task {} times as long; medians of {} rounds\n"
        "  a step takes {:.1f} us as it is\n"
        "  {:<32} {:>7} {:>13} {:>12} {:>12} {:>12} {:>11}\n",
        options_.scene.filename().string(), options_.n_steps,
        options_.n_threads == 1 ? "1 thread" : fmt::format("{} threads", options_.n_threads), slower, options_.n_rounds,
        median(steps_) * 1e6, "task", "share", "critical path", "by replay", "by a tenth", "measured", "difference");
    for (const SlowedTask& task : tasks_) {
      text += fmt::format("  {:<32} {:>6.1f}% {:>12.0f}% {:>9.1f} us {:>9.1f} us {:>9.1f} us {:>+10.1f}%\n", task.name,
                          task.share * 100, task.on_chain * 100, median(task.replayed) * 1e6,
                          median(task.extrapolated) * 1e6, median(task.measured) * 1e6, (median(task.ratio) - 1) * 100);
    }
    if (!is_too_busy()) return text;
    return text + fmt::format("  too busy to trust: other programs had these cores for {:.0f} % of the time\n",
                              100 * (1 - median(core_share_)));
  }

  const GainOptions& options_;
  tasks::Scene scene_;
  std::vector<SlowedTask> tasks_;
  /// Time of a step of the unchanged runs [s].
  std::vector<double> steps_;
  /// The share of each round in which its workers had their cores.
  std::vector<double> core_share_;
};

}  // namespace

Result gains(const GainOptions& options)
{
  return GainBenchmark(options).result();
}

}  // namespace tamp::tools::bench
