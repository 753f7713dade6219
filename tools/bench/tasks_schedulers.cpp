#include "tools/bench/tasks_schedulers.hpp"

namespace tamp::tools::bench
{

std::vector<TaskContestant> task_contestants()
{
  std::vector<TaskContestant> all{tamp_contestant(),
                                  declared_contestant(),
                                  loop_contestant(),
                                  barrier_contestant(),
                                  parallel_for_contestant(),
                                  flow_graph_contestant(),
                                  lightweight_flow_graph_contestant(),
                                  task_group_contestant()};
  if (const auto openmp = openmp_contestant()) all.push_back(*openmp);
  return all;
}

}  // namespace tamp::tools::bench
