#include "runtime/execute/stall_report.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace tamp::runtime
{

namespace
{

constexpr std::size_t most_lines = 20;
constexpr std::size_t most_predecessors = 4;

/// An instance that cannot run, with those that it waits for.
struct Blocked {
  int instance;
  std::vector<int> missing;
  bool at_front;
};

class Survey
{
 public:
  Survey(const ScheduleState& schedule, const std::vector<RunningInstance>& running) : schedule_(schedule)
  {
    for (const RunningInstance& r : running) running_.push_back(r.instance);
    for (const ScheduleState::List& list : schedule.lists()) {
      for (const ScheduleState::Entry& entry : list.entries) add(entry.instance);
    }
    std::stable_sort(blocked.begin(), blocked.end(), [](const Blocked& a, const Blocked& b) {
      return a.at_front != b.at_front ? a.at_front : a.instance < b.instance;
    });
  }

  std::size_t n_done = 0;
  std::size_t n_all = 0;
  std::size_t n_ready = 0;
  std::vector<Blocked> blocked;

 private:
  void add(int instance)
  {
    ++n_all;
    if (schedule_.is_done(instance)) {
      ++n_done;
    } else if (!is_running(instance)) {
      Blocked b{instance, {}, false};
      for (const int p : schedule_.work().predecessors(instance)) {
        if (schedule_.is_done(p)) continue;
        b.missing.push_back(p);
        b.at_front |= is_running(p) || !schedule_.is_own(p);
      }
      if (b.missing.empty()) {
        ++n_ready;
      } else {
        blocked.push_back(std::move(b));
      }
    }
  }
  bool is_running(int instance) const
  {
    return std::find(running_.begin(), running_.end(), instance) != running_.end();
  }

  const ScheduleState& schedule_;
  std::vector<int> running_;
};

std::string names_of(const Work& work, const std::vector<int>& missing)
{
  std::string text;
  const std::size_t n = std::min(missing.size(), most_predecessors);
  for (std::size_t k = 0; k < n; ++k) text += (k == 0 ? "" : ", ") + work.describe(missing[k]);
  if (missing.size() > n) text += fmt::format(", and {} more", missing.size() - n);
  return text;
}

}  // namespace

std::string stall_report(const ScheduleState& schedule, const std::vector<RunningInstance>& running, double idle_time)
{
  const Work& work = schedule.work();
  const Survey survey(schedule, running);
  std::string text = fmt::format("nothing has completed for {:.1f} s; {} of {} instances are done, {} ready\n",
                                 idle_time, survey.n_done, survey.n_all, survey.n_ready);
  for (const RunningInstance& r : running) {
    text += fmt::format("running for {:.1f} s on worker {}: {}\n", r.time, r.worker, work.describe(r.instance));
  }
  const std::size_t n_lines = std::min(survey.blocked.size(), most_lines);
  for (std::size_t k = 0; k < n_lines; ++k) {
    const Blocked& b = survey.blocked[k];
    text += fmt::format("blocked: {} waits for {}\n", work.describe(b.instance), names_of(work, b.missing));
  }
  if (survey.blocked.size() > n_lines) text += fmt::format("blocked: {} more\n", survey.blocked.size() - n_lines);
  return text;
}

}  // namespace tamp::runtime
