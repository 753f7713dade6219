#include "tools/study/run_points.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <csignal>
#include <memory>

#include "runtime/file_error.hpp"
#include "tools/study/quantities.hpp"
#include "tools/system/child_process.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools::study
{

namespace
{

namespace fs = std::filesystem;

/// Why a point's run ended; the last state that it kept is not kept here.
std::string reason_of(const Child& run)
{
  std::string said = error_text_of(run);
  said.erase(std::min(said.find("; the last state is kept in"), said.size()));
  return said;
}

/// Ended by itself at the limit, or by the kernel if it did not. A run that hit a limit of the machine's instead would
/// have had more time from the study.
bool hit_limit(const ChildEnd& end, double limit)
{
  if (!std::isfinite(limit)) return false;
  return end.exit_code == static_cast<int>(ExitCode::signal) + SIGXCPU || end.signal == SIGXCPU ||
         (end.signal == SIGKILL && end.user_s >= limit);
}

Cost cost_of(const Study& study, const Json& summary, double user_s)
{
  Cost cost{{"core_s", user_s}};
  if (study.measure.kind == Measure::Kind::run) {
    cost["steps"] = summary.at("steps").get<double>();
    cost["particle_steps"] = cost["steps"] * summary.at("particles").at("total").get<double>();
    return cost;
  }
  for (const CostKind& kind : cost_kinds(study.measure.kind)) cost[kind.key] = summary.at(kind.key).get<double>();
  return cost;
}

/// Points that are measured alike, and what is known of them.
struct Task {
  const Measurement* measurement;
  std::string label{};
  /// A chart shows its cost, which is therefore measured several times.
  bool is_charted = false;
  /// Neither the reference nor an error budget needs it, so that it has to keep up with the fastest point.
  bool only_charted = true;
  std::optional<PointResult> result{};
};

class PointRunner
{
 public:
  PointRunner(const Study& study, fs::path cache, bool quiet) : study_(study), cache_(std::move(cache)), quiet_(quiet)
  {
  }

  void add(const Point& point, const Measurement& measurement)
  {
    Task*& task = task_of_key_[measurement.key];
    if (task == nullptr) {
      tasks_.push_back(std::make_unique<Task>(Task{&measurement, point.name()}));
      task = tasks_.back().get();
      task->result = kept(*task);
      if (point.role == Point::Role::chart && task->result) note_time(*task->result);
    }
    const bool in_chart = point.role == Point::Role::chart;
    task->is_charted |= in_chart;
    task->only_charted &= in_chart;
  }

  void run()
  {
    for (int round = 0; round < study_.repeat; ++round) {
      for (std::size_t k = 0; k < tasks_.size(); ++k) {
        Task& task = *tasks_[(k + static_cast<std::size_t>(round)) % tasks_.size()];
        if (wants_timing(task, round)) time(task, round);
      }
    }
  }

  const PointResult& result(const std::string& key) const { return *task_of_key_.at(key)->result; }

 private:
  fs::path folder_of(const std::string& key) const { return cache_ / key; }

  /// A result that has all that the study asks for. One that is damaged is none, and is reported.
  std::optional<PointResult> kept(const Task& task) const
  {
    try {
      auto result = read_result(folder_of(task.measurement->key));
      if (result && result->end == End::done && !has_all(study_, *result)) return std::nullopt;
      return result;
    } catch (const runtime::FileError& damage) {
      print_err("tamp: warning: {}: {}: it is run again\n", task.label, damage.what());
      return std::nullopt;
    }
  }

  /// Whether a point that took too long has more time now.
  bool may_take_longer(const Task& task) const
  {
    constexpr double clearly = 1.1;  // the fastest point's time scatters
    return task.result->end == End::limit && limit_of(task) > clearly * task.result->limit;
  }

  bool wants_timing(const Task& task, int round) const
  {
    if (!task.result) return true;
    if (round == 0 && may_take_longer(task)) return true;
    if (round == 0 || !task.is_charted || task.result->end != End::done) return false;
    const double seconds = task.result->cost("core_s")->median;
    return static_cast<int>(task.result->costs.size()) <= round && seconds < study_.repeat_below &&
           seconds < limit_of(task);
  }

  void note_time(const PointResult& result)
  {
    if (result.end == End::done) fastest_ = std::min(fastest_, result.cost("core_s")->median);
  }

  double limit_of(const Task& task) const
  {
    if (!task.only_charted) return study_.limit;
    return std::min(study_.limit, study_.limit_over_fastest * fastest_);
  }

  void time(Task& task, int round)
  {
    const fs::path folder = folder_of(task.measurement->key), fresh = folder.string() + ".new";
    PointResult result = one_run(task, fresh);
    const bool was_done = task.result && task.result->end == End::done;
    if (was_done && result.end != End::done) {  // the answer is known; the machine was too busy for a timing
      fs::remove_all(fresh);
      return;
    }
    if (was_done) result.costs.insert(result.costs.begin(), task.result->costs.begin(), task.result->costs.end());
    if (result.end == End::done) expect_all(study_, result);
    write_result(result, task.measurement->key);
    fs::remove_all(folder);
    fs::rename(fresh, folder);
    result.folder = folder;
    if (task.is_charted) note_time(result);
    task.result = std::move(result);
    show_progress(task, round);
  }

  PointResult one_run(const Task& task, const fs::path& folder) const
  {
    const fs::path errors = cache_ / "errors.txt";
    fs::remove_all(folder);
    fs::remove_all(errors);  // a pipe would wait for a reader
    fs::create_directories(folder);
    const double limit = limit_of(task);
    const Child run{command_into(study_, *task.measurement, folder), errors, "", limit};
    const ChildEnd end = run_child(run);
    PointResult result{End::done, "", {}, limit, folder};
    if (end.done()) {
      result.costs.push_back(cost_of(study_, summary_in(folder), end.user_s));
    } else {
      result.costs.push_back({{"core_s", end.user_s}});
      note_failure(end, limit, reason_of(run), result);
    }
    remove_what_is_not_asked_for(folder);
    return result;
  }

  void note_failure(const ChildEnd& end, double limit, const std::string& said, PointResult& result) const
  {
    if (hit_limit(end, limit)) {
      result.end = End::limit;
      result.reason = fmt::format("not done after {:.3g} s of processor time", end.user_s);
    } else if (end.exit_code == static_cast<int>(ExitCode::bad_simulation)) {
      result.end = End::unstable;
      result.reason = said;
    } else if (end.exit_code == static_cast<int>(ExitCode::bad_input)) {
      result.end = End::refused;
      result.reason = said;
    } else {
      throw runtime::FileError(result.folder.string(), said.empty() ? "a run ended with " + end.description() : said);
    }
  }

  /// Fields and checkpoints are large.
  void remove_what_is_not_asked_for(const fs::path& folder) const
  {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      const bool stays = name == "history.csv" || name == "summary.json" || name == "scene.json" ||
                         (name == "fields.h5" && asks_for_fields(study_));
      if (!stays) found.push_back(entry.path());
    }
    for (const fs::path& file : found) fs::remove_all(file);
  }

  void show_progress(const Task& task, int round) const
  {
    if (quiet_) return;
    const auto is_known = [](const auto& one) { return one->result.has_value(); };
    const auto n_known = std::count_if(tasks_.begin(), tasks_.end(), is_known);
    const double seconds = task.result->costs.back().at("core_s");
    print_err("{} of {}{}: {}: {}, {:.3g} s\n", n_known, tasks_.size(),
              round == 0 ? "" : fmt::format(", timing {}", round + 1), task.label, to_text(task.result->end), seconds);
  }

  const Study& study_;
  fs::path cache_;
  bool quiet_;
  std::vector<std::unique_ptr<Task>> tasks_;
  std::map<std::string, Task*> task_of_key_;
  /// User time of the fastest point that is done [s].
  double fastest_ = std::numeric_limits<double>::infinity();
};

/// Which points are too slow may not depend on the order in which they ran, or on what was known of them before.
void apply_limits(const Study& study, const std::vector<Point>& points, std::vector<PointResult>& results)
{
  const auto counts = [&](std::size_t i) {
    return points[i].role == Point::Role::chart && results[i].end == End::done;
  };
  double fastest = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (counts(i)) fastest = std::min(fastest, results[i].cost("core_s")->median);
  }
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!counts(i)) continue;
    const double seconds = results[i].cost("core_s")->median;
    if (seconds <= std::min(std::max(study.limit, 1.0), study.limit_over_fastest * fastest)) continue;
    results[i].end = End::limit;
    results[i].reason =
        fmt::format("took {:.3g} s, {:.3g} times as long as the fastest point", seconds, seconds / fastest);
  }
}

}  // namespace

std::vector<PointResult> run_points(const Study& study, const std::vector<Point>& points,
                                    const std::vector<Measurement>& measurements, const fs::path& cache, bool quiet)
{
  PointRunner runner(study, cache, quiet);
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (measurements[i].refusal.empty()) runner.add(points[i], measurements[i]);
  }
  runner.run();
  std::vector<PointResult> results;
  results.reserve(measurements.size());
  for (const Measurement& measurement : measurements) {
    results.push_back(measurement.refusal.empty() ? runner.result(measurement.key)
                                                  : PointResult{End::refused, measurement.refusal, {}, 0, {}});
  }
  apply_limits(study, points, results);
  return results;
}

}  // namespace tamp::tools::study
