#include "tools/bench/tasks_schedulers.hpp"

#if defined(_OPENMP)
#  include <omp.h>
#endif

namespace tamp::tools::bench
{

#if defined(_OPENMP)

namespace
{

class OpenMpTasks : public TaskScheduler
{
 public:
  OpenMpTasks(StampedTasks& tasks, int n_threads)
      : tasks_(tasks), n_threads_(n_threads), outputs_(static_cast<std::size_t>(tasks.size()))
  {
  }
  /// Its threads would spin on for a while and disturb what is measured next.
  ~OpenMpTasks() override { omp_pause_resource_all(omp_pause_soft); }
  OpenMpTasks(const OpenMpTasks&) = delete;
  OpenMpTasks& operator=(const OpenMpTasks&) = delete;

  void run(int n_runs) override
  {
#  pragma omp parallel num_threads(n_threads_)
#  pragma omp single
    for (int i = 0; i < n_runs; ++i) {
      tasks_.begin_run();
      create_tasks();
#  pragma omp taskwait
    }
  }

 private:
  void create_tasks()
  {
    // Names in depend clauses: one byte stands for the output of a task.
    [[maybe_unused]] char* const made = outputs_.data();
    for (int task = 0; task < tasks_.size(); ++task) {
      [[maybe_unused]] const int* const input = tasks_.inputs(task).data();
      [[maybe_unused]] const int n_inputs = static_cast<int>(tasks_.inputs(task).size());
#  pragma omp task firstprivate(task) depend(iterator(k = 0 : n_inputs), in : made[input[k]]) depend(out : made[task])
      tasks_.run(task);
    }
  }

  StampedTasks& tasks_;
  int n_threads_;
  std::vector<char> outputs_;
};

}  // namespace

std::optional<TaskContestant> openmp_contestant()
{
  return TaskContestant{"OpenMP tasks, made anew",
                        [](StampedTasks& tasks, int n_threads) -> std::unique_ptr<TaskScheduler> {
                          return std::make_unique<OpenMpTasks>(tasks, n_threads);
                        }};
}

#else

std::optional<TaskContestant> openmp_contestant()
{
  return std::nullopt;
}

#endif

}  // namespace tamp::tools::bench
