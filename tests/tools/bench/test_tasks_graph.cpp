#include <catch2/catch.hpp>
#include <numeric>

#include "runtime/execute/executor.hpp"
#include "tools/bench/tasks_graph.hpp"
#include "tools/bench/tasks_schedulers.hpp"

namespace test_tasks_graph
{

using namespace tamp;
using namespace tamp::tools::bench;

namespace
{

std::vector<int> in_order(const StampedTasks& tasks)
{
  std::vector<int> order(static_cast<std::size_t>(tasks.size()));
  std::iota(order.begin(), order.end(), 0);
  return order;
}

void run(StampedTasks& tasks, const std::vector<int>& order)
{
  tasks.begin_run();
  for (const int task : order) tasks.run(task);
}

/// Declares what tasks read, but for the last input of one of them.
struct Forgetful : runtime::Work {
  Forgetful(StampedTasks& tasks_, int forgetful_) : tasks(tasks_), forgetful(forgetful_) {}

  int n_instances() const override { return tasks.size(); }
  std::span<const int> predecessors(int task) const override
  {
    const std::span<const int> all = tasks.inputs(task);
    return task == forgetful ? all.first(all.size() - 1) : all;
  }
  int home(int, int) const override { return 0; }
  void run(int task, const runtime::Step&) override { tasks.run(task); }
  std::string describe(int task) const override { return tasks.describe(task); }

  StampedTasks& tasks;
  int forgetful;
};

std::string fault_after_shuffled_runs(int forgetful)
{
  StampedTasks tasks(stencil_pattern(4, 3));
  Forgetful work(tasks, forgetful);
  runtime::Schedule schedule(work, 1);
  const auto executor = runtime::Executor::shuffled(7);
  for (int i = 0; i < 50; ++i) {
    tasks.begin_run();
    executor->run(schedule, {});
  }
  return tasks.fault();
}

std::string fault_of(const TaskContestant& contestant, const TaskPattern& pattern, int n_threads)
{
  StampedTasks tasks(pattern);
  const auto scheduler = contestant.make(tasks, n_threads);
  scheduler->run(1);
  scheduler->run(20);
  return tasks.fault();
}

void check_all_patterns(const TaskContestant& contestant, int n_threads)
{
  for (const TaskPattern& pattern :
       {stencil_pattern(7, 5), nearest_27_pattern(3, 4), fft_pattern(7, 5), tree_pattern(8, 6)}) {
    if (!pattern.shape && contestant.reads_neighbours_only) continue;
    INFO(pattern.name);
    CHECK(fault_of(contestant, pattern, n_threads).empty());
  }
}

}  // namespace

TEST_CASE("a task reads the row before, and the first row reads nothing")
{
  const StampedTasks tasks(stencil_pattern(4, 3));

  CHECK(tasks.size() == 12);
  CHECK(tasks.inputs(3).empty());
  CHECK(std::vector<int>(tasks.inputs(9).begin(), tasks.inputs(9).end()) == std::vector<int>{4, 5, 6});
  CHECK(tasks.readers()[0] == std::vector<int>{4, 5});
  CHECK(tasks.readers()[8].empty());
  CHECK(tasks.describe(9) == "step 2, point 1");
}

TEST_CASE("a row may be wider than the one before it")
{
  const StampedTasks tasks(tree_pattern(4, 4));

  CHECK(tasks.size() == 11);
  CHECK(tasks.row(2) == 3);
  CHECK(tasks.step_of(6) == 2);
  CHECK(tasks.describe(6) == "step 2, point 3");
  CHECK(std::vector<int>(tasks.inputs(6).begin(), tasks.inputs(6).end()) == std::vector<int>{2});
  CHECK(tasks.readers()[2] == std::vector<int>{5, 6});
}

TEST_CASE("tasks run in order, again and again, are without fault")
{
  StampedTasks tasks(stencil_pattern(4, 3));

  for (int i = 0; i < 3; ++i) run(tasks, in_order(tasks));

  CHECK(tasks.fault().empty());
}

TEST_CASE("a task that runs before one of its inputs, in any run, is found")
{
  StampedTasks tasks(stencil_pattern(4, 3));
  std::vector<int> order = in_order(tasks);
  std::swap(order[3], order[6]);

  run(tasks, in_order(tasks));
  run(tasks, order);
  run(tasks, in_order(tasks));

  CHECK(tasks.fault() == "the task of step 1, point 2 ran before what it reads, or twice");
}

TEST_CASE("a task that runs twice or not at all is found")
{
  StampedTasks twice(stencil_pattern(4, 3)), left_out(stencil_pattern(4, 3));

  run(twice, in_order(twice));
  twice.run(11);
  run(left_out, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10});

  CHECK(twice.fault() == "the task of step 2, point 3 ran before what it reads, or twice");
  CHECK(left_out.fault() == "the task of step 2, point 3 was left out");
}

TEST_CASE("an edge that is not declared is found in shuffled order")
{
  CHECK(fault_after_shuffled_runs(-1).empty());
  CHECK(fault_after_shuffled_runs(5) == "the task of step 1, point 1 ran before what it reads, or twice");
}

TEST_CASE("TAMP's executor and engine, a loop and a team with barriers run every task once, after what it reads")
{
  const int n_threads = GENERATE(1, 2, 3);

  for (const TaskContestant& contestant :
       {tamp_contestant(), declared_contestant(), loop_contestant(), barrier_contestant()}) {
    INFO(contestant.name << ", " << n_threads << " threads");
    check_all_patterns(contestant, n_threads);
  }
}

#if !defined(__SANITIZE_THREAD__)  // which sees neither what oneTBB's library does nor what OpenMP's does
TEST_CASE("every scheduler of the comparison runs every task once, after what it reads")
{
  const int n_threads = GENERATE(1, 2, 3);

  for (const TaskContestant& contestant : task_contestants()) {
    INFO(contestant.name << ", " << n_threads << " threads");
    check_all_patterns(contestant, n_threads);
  }
}
#endif

}  // namespace test_tasks_graph
