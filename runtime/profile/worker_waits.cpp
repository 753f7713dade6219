#include "runtime/profile/worker_waits.hpp"

#include <algorithm>
#include <cstddef>
#include <tuple>

namespace tamp::runtime
{

void WorkerWaits::make_room(std::size_t n_rows)
{
  if (n_rows < n_rows_) return;
  // Old rows keep their numbers, but for the last, of the end of the step.
  std::vector<std::uint64_t> ticks((n_rows + 1) * n_rows, 0);
  for (std::size_t row = 0; n_rows_ > 0 && row <= n_rows_; ++row) {
    const std::size_t to = row == n_rows_ ? n_rows : row;
    for (std::size_t cause = 0; cause < n_rows_; ++cause) ticks[to * n_rows + cause] = ticks_[row * n_rows_ + cause];
  }
  ticks_ = std::move(ticks);
  n_rows_ = n_rows;
}

void WorkerWaits::add_step(const BoundGraph& graph, const std::vector<InstanceRecord>& records,
                           const std::vector<std::size_t>& row_of_instance)
{
  const auto& instances = graph.graph().instances();
  const auto at = [&](int i) -> const InstanceRecord& { return records[static_cast<std::size_t>(i)]; };
  const auto row = [&](int i) { return row_of_instance[static_cast<std::size_t>(i)]; };
  order_.clear();
  order_.reserve(instances.size());
  for (int i = 0; i < static_cast<int>(instances.size()); ++i) {
    if (graph.is_local(i)) order_.push_back(i);
  }
  if (order_.empty()) return;
  std::sort(order_.begin(), order_.end(),
            [&](int a, int b) { return std::tie(at(a).worker, at(a).start) < std::tie(at(b).worker, at(b).start); });
  const auto earlier_end = [&](int a, int b) { return at(a).end < at(b).end; };
  const auto earlier_start = [&](int a, int b) { return at(a).start < at(b).start; };
  const int last = *std::max_element(order_.begin(), order_.end(), earlier_end);
  const std::uint64_t begin = at(*std::min_element(order_.begin(), order_.end(), earlier_start)).start;
  std::uint64_t free = begin;
  for (std::size_t k = 0; k < order_.size(); ++k) {
    const int i = order_[k];
    const auto& before = instances[static_cast<std::size_t>(i)].predecessors;
    const auto cause = std::max_element(before.begin(), before.end(), earlier_end);
    if (cause != before.end()) {
      const std::uint64_t until = std::min(at(*cause).end, at(i).start);
      if (until > free) add(row(i), row(*cause), until - free);
    }
    free = at(i).end;
    const bool is_workers_last = k + 1 == order_.size() || at(order_[k + 1]).worker != at(i).worker;
    if (!is_workers_last) continue;
    if (at(last).end > free) add(n_rows_, row(last), at(last).end - free);
    free = begin;
  }
}

}  // namespace tamp::runtime
