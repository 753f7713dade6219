#include "runtime/profile/replay.hpp"

#include <algorithm>
#include <cstddef>
#include <queue>
#include <set>
#include <tuple>

namespace tamp::runtime
{

namespace
{

std::size_t place(int i)
{
  return static_cast<std::size_t>(i);
}

/// How long an instance's result is on its way to another: a message takes its time from its sender to its receiver.
double way(const TimedStep& step, int from, int to)
{
  const Instance& receiver = step.graph->instances()[place(to)];
  if (receiver.kind != InstanceKind::receive_message) return 0;
  const bool is_sender = step.graph->messages()[place(receiver.message)].send == from;
  return is_sender ? step.message_s[place(receiver.message)] : 0;
}

/// The workers of all ranks, and what waits for them.
class Replay
{
 public:
  Replay(const TimedStep& step, int n_workers)
      : step_(step),
        n_workers_(n_workers),
        instances_(step.graph->instances()),
        n_ranks_(step.graph->layout().n_ranks()),
        homes_(homes_of(*step.graph, n_workers))
  {
    find_successors();
    ready_.resize(place(n_ranks_ * n_workers_));
    idle_.resize(place(n_ranks_));
    for (int rank = 0; rank < n_ranks_; ++rank) {
      for (int w = 0; w < n_workers_; ++w) idle_[place(rank)].insert(w);
    }
  }

  double run()
  {
    for (int i = 0; i < static_cast<int>(instances_.size()); ++i) {
      if (n_awaited_[place(i)] == 0) ready_[place(homes_[place(i)])].insert(i);
    }
    for (int rank = 0; rank < n_ranks_; ++rank) start_what_can(rank);
    while (!events_.empty()) {
      const auto [time, instance, worker] = events_.top();
      events_.pop();
      now_ = time;
      const int rank = instances_[place(instance)].rank;
      if (worker < 0) {
        ready_[place(homes_[place(instance)])].insert(instance);
      } else {
        idle_[place(rank)].insert(worker);
        release_successors(instance);
      }
      start_what_can(rank);
    }
    return now_;
  }

 private:
  /// When something happens: a worker is done with an instance, or (worker -1) an instance becomes ready.
  using Event = std::tuple<double, int, int>;

  void find_successors()
  {
    first_.assign(instances_.size() + 1, 0);
    n_awaited_.resize(instances_.size());
    ready_at_.assign(instances_.size(), 0);
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      n_awaited_[i] = instances_[i].predecessors.size();
      for (const int p : instances_[i].predecessors) ++first_[place(p) + 1];
    }
    for (std::size_t i = 0; i < instances_.size(); ++i) first_[i + 1] += first_[i];
    successors_.resize(first_.back());
    std::vector<std::size_t> next(first_.begin(), first_.end() - 1);
    for (std::size_t i = 0; i < instances_.size(); ++i) {
      for (const int p : instances_[i].predecessors) successors_[next[place(p)]++] = static_cast<int>(i);
    }
  }

  void release_successors(int instance)
  {
    for (std::size_t k = first_[place(instance)]; k < first_[place(instance) + 1]; ++k) {
      const int next = successors_[k];
      ready_at_[place(next)] = std::max(ready_at_[place(next)], now_ + way(step_, instance, next));
      if (--n_awaited_[place(next)] > 0) continue;
      // One that is ready now on the same rank is started below; any other is started by an event.
      const bool is_here = instances_[place(next)].rank == instances_[place(instance)].rank;
      if (is_here && ready_at_[place(next)] <= now_) {
        ready_[place(homes_[place(next)])].insert(next);
      } else {
        events_.emplace(ready_at_[place(next)], next, -1);
      }
    }
  }

  void start_what_can(int rank)
  {
    std::set<int>& idle = idle_[place(rank)];
    for (auto worker = idle.begin(); worker != idle.end();) {
      const int instance = take(rank, *worker);
      if (instance < 0) {
        ++worker;
        continue;
      }
      events_.emplace(now_ + step_.instance_s[place(instance)], instance, *worker);
      worker = idle.erase(worker);
    }
  }

  /// The first instance that is ready of a worker's own, or the last of another worker's; -1 if there is none.
  int take(int rank, int worker)
  {
    for (int k = 0; k < n_workers_; ++k) {
      std::set<int>& of = ready_[place(rank * n_workers_ + (worker + k) % n_workers_)];
      if (of.empty()) continue;
      const auto taken = k == 0 ? of.begin() : std::prev(of.end());
      const int instance = *taken;
      of.erase(taken);
      return instance;
    }
    return -1;
  }

  const TimedStep& step_;
  int n_workers_;
  const std::vector<Instance>& instances_;
  int n_ranks_;
  /// By instance: its home (rank times workers plus worker), the number of predecessors that it still waits for, and
  /// the earliest time at which it may be ready [s].
  std::vector<int> homes_;
  std::vector<std::size_t> n_awaited_;
  std::vector<double> ready_at_;
  /// Successors of all instances: those of instance i stand from first_[i] to first_[i + 1].
  std::vector<std::size_t> first_;
  std::vector<int> successors_;
  /// Instances that are ready, by home; and the idle workers, by rank.
  std::vector<std::set<int>> ready_;
  std::vector<std::set<int>> idle_;
  std::priority_queue<Event, std::vector<Event>, std::greater<>> events_;
  double now_ = 0;
};

}  // namespace

std::vector<int> homes_of(const TaskGraph& graph, int n_workers)
{
  std::vector<int> n_patches(place(graph.layout().n_ranks()), 0), row, homes;
  for (const Patch& patch : graph.layout()) row.push_back(n_patches[place(patch.rank)]++);
  homes.reserve(graph.instances().size());
  for (const Instance& instance : graph.instances()) {
    const int worker =
        instance.patch < 0 ? 0 : row[place(instance.patch)] * n_workers / n_patches[place(instance.rank)];
    homes.push_back(instance.rank * n_workers + worker);
  }
  return homes;
}

double replay(const TimedStep& step, int n_workers)
{
  return Replay(step, n_workers).run();
}

Chain longest_chain(const TimedStep& step)
{
  const auto& instances = step.graph->instances();
  if (instances.empty()) return {};
  std::vector<double> end(instances.size(), 0);
  std::vector<int> before(instances.size(), -1);
  for (std::size_t i = 0; i < instances.size(); ++i) {
    for (const int p : instances[i].predecessors) {
      const double there = end[place(p)] + way(step, p, static_cast<int>(i));
      if (before[i] >= 0 && there <= end[i]) continue;
      end[i] = there;
      before[i] = p;
    }
    end[i] += step.instance_s[i];
  }
  const auto last = std::max_element(end.begin(), end.end());
  Chain chain;
  chain.length_s = *last;
  for (int i = static_cast<int>(last - end.begin()); i >= 0; i = before[place(i)]) chain.instances.push_back(i);
  std::reverse(chain.instances.begin(), chain.instances.end());
  for (std::size_t k = 0; k < chain.instances.size(); ++k) {
    chain.message_s.push_back(k == 0 ? 0 : way(step, chain.instances[k - 1], chain.instances[k]));
  }
  return chain;
}

}  // namespace tamp::runtime
