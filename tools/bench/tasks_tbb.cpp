#include <oneapi/tbb/flow_graph.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/parallel_for.h>
#include <oneapi/tbb/task_arena.h>
#include <oneapi/tbb/task_group.h>

#include <atomic>
#include <deque>

#include "tools/bench/tasks_schedulers.hpp"

namespace tamp::tools::bench
{

namespace
{

namespace flow = oneapi::tbb::flow;

/// As many threads as are asked for; all runs of a measurement stay inside of one arena.
struct Arena {
  explicit Arena(int n_threads)
      : concurrency(oneapi::tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(n_threads)),
        arena(n_threads)
  {
  }
  oneapi::tbb::global_control concurrency;
  oneapi::tbb::task_arena arena;
};

class ParallelFor : public TaskScheduler
{
 public:
  ParallelFor(StampedTasks& tasks, int n_threads) : tasks_(tasks), arena_(n_threads) {}

  void run(int n_runs) override
  {
    arena_.arena.execute([&] {
      for (int i = 0; i < n_runs; ++i) {
        tasks_.begin_run();
        for (int step = 0; step < tasks_.n_steps(); ++step) {
          oneapi::tbb::parallel_for(
              tasks_.row(step), tasks_.row(step + 1), [this](int task) { tasks_.run(task); },
              oneapi::tbb::static_partitioner());
        }
      }
    });
  }

 private:
  StampedTasks& tasks_;
  Arena arena_;
};

template <class Node>
class FlowGraph : public TaskScheduler
{
 public:
  FlowGraph(StampedTasks& tasks, int n_threads) : tasks_(tasks), arena_(n_threads)
  {
    arena_.arena.execute([this] { build(); });
  }

  void run(int n_runs) override
  {
    arena_.arena.execute([&] {
      for (int i = 0; i < n_runs; ++i) {
        tasks_.begin_run();
        start_->try_put(flow::continue_msg());
        graph_->wait_for_all();
      }
    });
  }

 private:
  /// Inside of the arena: a graph runs in the one that it was made in.
  void build()
  {
    graph_.emplace();
    start_.emplace(*graph_);
    for (int task = 0; task < tasks_.size(); ++task) {
      Node& node = nodes_.emplace_back(*graph_, [this, task](const flow::continue_msg&) noexcept { tasks_.run(task); });
      if (task < tasks_.row(1)) flow::make_edge(*start_, node);
      for (const int input : tasks_.inputs(task)) flow::make_edge(nodes_[static_cast<std::size_t>(input)], node);
    }
  }

  StampedTasks& tasks_;
  Arena arena_;
  std::optional<flow::graph> graph_;
  std::optional<flow::broadcast_node<flow::continue_msg>> start_;
  std::deque<Node> nodes_;
};

class TaskGroup : public TaskScheduler
{
 public:
  TaskGroup(StampedTasks& tasks, int n_threads)
      : tasks_(tasks), arena_(n_threads), readers_(tasks.readers()), counters_(static_cast<std::size_t>(tasks.size()))
  {
    for (int task = 0; task < tasks.size(); ++task) counter(task) = n_inputs(task);
  }
  /// A task_group's destructor throws when it was not waited for, which does not happen here.
  ~TaskGroup() noexcept override = default;

  void run(int n_runs) override
  {
    arena_.arena.execute([&] {
      for (int i = 0; i < n_runs; ++i) {
        tasks_.begin_run();
        for (int task = 0; task < tasks_.row(1); ++task) start(task);
        group_.wait();
      }
    });
  }

 private:
  /// On a cache line of its own: packed counters cost a third more on two threads.
  struct alignas(64) Counter {
    std::atomic<int> n_awaited{0};
  };

  std::atomic<int>& counter(int task) { return counters_[static_cast<std::size_t>(task)].n_awaited; }
  int n_inputs(int task) const { return static_cast<int>(tasks_.inputs(task).size()); }

  void start(int task)
  {
    group_.run([this, task] {
      for (int next = task; next >= 0;) next = complete(next);
    });
  }

  /// Returns one of the tasks that can go on now and starts the others; -1 if there is none.
  int complete(int task)
  {
    tasks_.run(task);
    // Whoever decrements it next does so in the next run.
    counter(task).store(n_inputs(task), std::memory_order_relaxed);
    int next = -1;
    for (const int reader : readers_[static_cast<std::size_t>(task)]) {
      if (counter(reader).fetch_sub(1, std::memory_order_acq_rel) > 1) continue;
      if (next < 0) {
        next = reader;
      } else {
        start(reader);
      }
    }
    return next;
  }

  StampedTasks& tasks_;
  Arena arena_;
  oneapi::tbb::task_group group_;
  std::vector<std::vector<int>> readers_;
  std::vector<Counter> counters_;
};

template <class Scheduler>
std::unique_ptr<TaskScheduler> make(StampedTasks& tasks, int n_threads)
{
  return std::make_unique<Scheduler>(tasks, n_threads);
}

}  // namespace

TaskContestant parallel_for_contestant()
{
  return {"tbb::parallel_for per step", make<ParallelFor>};
}

TaskContestant flow_graph_contestant()
{
  return {"tbb flow graph", make<FlowGraph<flow::continue_node<flow::continue_msg>>>};
}

TaskContestant lightweight_flow_graph_contestant()
{
  return {"tbb flow graph, lightweight", make<FlowGraph<flow::continue_node<flow::continue_msg, flow::lightweight>>>};
}

TaskContestant task_group_contestant()
{
  return {"tbb::task_group, counters", make<TaskGroup>};
}

}  // namespace tamp::tools::bench
