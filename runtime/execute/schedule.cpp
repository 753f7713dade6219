#include "runtime/execute/schedule.hpp"

namespace tamp::runtime
{

Schedule::Schedule(Work& work, int n_workers)
    : work_(work),
      slots_(static_cast<std::size_t>(work.n_instances())),
      lists_(static_cast<std::size_t>(n_workers)),
      records_(slots_.size())
{
  for (int i = 0; i < work.n_instances(); ++i) {
    slots_[static_cast<std::size_t>(i)].predecessors = work.predecessors(i);
    const int home = work.home(i, n_workers);
    if (home >= 0) lists_[static_cast<std::size_t>(home)].push_back(i);
  }
}

}  // namespace tamp::runtime
