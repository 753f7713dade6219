#include "runtime/profile/task_rows.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <span>

namespace tamp::runtime
{

void TaskTotals::add(const TaskTotals& other)
{
  durations.merge(other.durations);
  over_time.add(other.over_time);
  skipped += other.skipped;
  ready_delay += other.ready_delay;
  processor_ns += other.processor_ns;
  on_chain += other.on_chain;
  bytes += other.bytes;
  particles += other.particles;
}

void TaskRow::add(const TaskRow& other)
{
  totals.add(other.totals);
  for (std::size_t p = 0; p < per_patch.size(); ++p) per_patch[p] += other.per_patch[p];
}

void for_each_rank(const std::vector<TaskRow>& own, const Communicator& communicator,
                   const std::function<void(int rank, const std::vector<TaskRow>& rows)>& look)
{
  std::vector<std::byte> bytes;
  const auto append = [&](const auto* first, std::size_t n) {
    const auto more = std::as_bytes(std::span(first, n));
    bytes.insert(bytes.end(), more.begin(), more.end());
  };
  for (const TaskRow& row : own) {
    append(&row.totals, 1);
    append(row.per_patch.data(), row.per_patch.size());
  }
  const auto from_each = communicator.gather(bytes);
  std::vector<TaskRow> rows = own;
  for (int rank = 0; rank < communicator.size(); ++rank) {
    const std::byte* from = from_each[static_cast<std::size_t>(rank)].data();
    for (TaskRow& row : rows) {
      std::memcpy(static_cast<void*>(&row.totals), from, sizeof row.totals);
      from += sizeof row.totals;
      const std::size_t n_bytes = row.per_patch.size() * sizeof(std::uint64_t);
      std::memcpy(row.per_patch.data(), from, n_bytes);
      from += n_bytes;
    }
    look(rank, rows);
  }
}

std::uint64_t ticks_of(const std::vector<TaskRow>& rows)
{
  std::uint64_t ticks = 0;
  for (const TaskRow& row : rows) ticks += row.totals.durations.total();
  return ticks;
}

namespace
{

/// Time of the busiest patch over the mean of all patches; for one rank, of those that it worked on or has at the end.
double imbalance(const TaskRow& row, int rank, const std::vector<int>& rank_of_patch)
{
  std::uint64_t sum = 0, most = 0, n = 0;
  for (std::size_t p = 0; p < row.per_patch.size(); ++p) {
    const std::uint64_t ticks = row.per_patch[p];
    sum += ticks;
    most = std::max(most, ticks);
    n += std::uint64_t{ticks > 0 || rank < 0 || !row.over_patches || rank_of_patch[p] == rank};
  }
  return sum > 0 ? static_cast<double>(most) * static_cast<double>(n) / static_cast<double>(sum) : 1;
}

TaskStatistics statistics(const TaskRow& row, const RowScales& scales, const std::vector<int>& rank_of_patch)
{
  const DurationHistogram& durations = row.totals.durations;
  const double second = scales.second_per_tick;
  TaskStatistics t;
  t.name = row.name;
  t.count = durations.count();
  t.skipped = row.totals.skipped;
  t.total_s = static_cast<double>(durations.total()) * second;
  t.mean_s = t.count > 0 ? t.total_s / static_cast<double>(t.count) : 0;
  t.min_s = static_cast<double>(durations.least()) * second;
  t.max_s = static_cast<double>(durations.most()) * second;
  t.p95_s = durations.quantile(0.95) * second;
  t.share = scales.all_ticks > 0 ? static_cast<double>(durations.total()) / static_cast<double>(scales.all_ticks) : 0;
  if (scales.processor_steps > 0) {
    t.processor_s = 1e-9 * static_cast<double>(row.totals.processor_ns) * scales.processor_steps;
  }
  t.bytes = row.totals.bytes * scales.steps;
  t.particles = row.totals.particles * scales.steps;
  t.imbalance = imbalance(row, scales.rank, rank_of_patch);
  t.ready_delay_s = static_cast<double>(row.totals.ready_delay) * second * scales.time;
  t.on_chain = scales.looked_at > 0 ? static_cast<double>(row.totals.on_chain) / scales.looked_at : 0;
  return t;
}

}  // namespace

std::vector<TaskStatistics> statistics(const std::vector<TaskRow>& rows, const RowScales& scales,
                                       const std::vector<int>& rank_of_patch)
{
  std::vector<TaskStatistics> tasks;
  for (const TaskRow& row : rows) {
    if (row.totals.durations.count() + row.totals.skipped > 0) tasks.push_back(statistics(row, scales, rank_of_patch));
  }
  std::sort(tasks.begin(), tasks.end(),
            [](const TaskStatistics& a, const TaskStatistics& b) { return a.total_s > b.total_s; });
  return tasks;
}

std::vector<PatchStatistics> patch_statistics(const std::vector<TaskRow>& rows, const std::vector<int>& ranks,
                                              double second_per_tick)
{
  std::vector<PatchStatistics> patches(ranks.size());
  std::vector<std::uint64_t> most(ranks.size(), 0);
  for (std::size_t p = 0; p < ranks.size(); ++p) patches[p].rank = ranks[p];
  for (const TaskRow& row : rows) {
    if (!row.over_patches) continue;
    for (std::size_t p = 0; p < ranks.size(); ++p) {
      patches[p].total_s += static_cast<double>(row.per_patch[p]) * second_per_tick;
      if (row.per_patch[p] <= most[p]) continue;
      most[p] = row.per_patch[p];
      patches[p].dearest = row.name;
    }
  }
  return patches;
}

}  // namespace tamp::runtime
