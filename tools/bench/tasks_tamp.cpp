#include "runtime/execute/executor.hpp"
#include "runtime/execute/work.hpp"
#include "tools/bench/tasks_schedulers.hpp"

namespace tamp::tools::bench
{

namespace
{

/// Neighbouring points share a worker, as neighbouring patches do.
class StampedWork : public runtime::Work
{
 public:
  explicit StampedWork(StampedTasks& tasks) : tasks_(tasks) {}

  int n_instances() const override { return tasks_.size(); }
  std::span<const int> predecessors(int instance) const override { return tasks_.inputs(instance); }
  int home(int instance, int n_workers) const override
  {
    const int step = tasks_.step_of(instance), first = tasks_.row(step);
    return (instance - first) * n_workers / (tasks_.row(step + 1) - first);
  }
  void run(int instance, const runtime::Step& /*step*/) override { tasks_.run(instance); }
  std::string describe(int instance) const override { return tasks_.describe(instance); }

 private:
  StampedTasks& tasks_;
};

class TampScheduler : public TaskScheduler
{
 public:
  TampScheduler(StampedTasks& tasks, int n_threads)
      : tasks_(tasks), work_(tasks), schedule_(work_, n_threads), executor_(n_threads)
  {
  }

  void run(int n_runs) override
  {
    for (int i = 0; i < n_runs; ++i) {
      tasks_.begin_run();
      executor_.run(schedule_, step_);
    }
  }

 private:
  StampedTasks& tasks_;
  StampedWork work_;
  runtime::Schedule schedule_;
  runtime::Executor executor_;
  runtime::Step step_;
};

}  // namespace

TaskContestant tamp_contestant()
{
  return {"tamp", [](StampedTasks& tasks, int n_threads) -> std::unique_ptr<TaskScheduler> {
            return std::make_unique<TampScheduler>(tasks, n_threads);
          }};
}

}  // namespace tamp::tools::bench
