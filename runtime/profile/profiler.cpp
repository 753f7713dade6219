#include "runtime/profile/profiler.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <numeric>
#include <utility>

namespace tamp::runtime
{

void DurationHistogram::add(std::uint64_t ticks)
{
  ++count_;
  total_ += ticks;
  least_ = std::min(least_, ticks);
  most_ = std::max(most_, ticks);
  // The octave is the place of the top bit; the next five bits tell the bin within it.
  const std::uint64_t value = std::max<std::uint64_t>(ticks, bins_per_octave);
  const auto octave = static_cast<int>(std::bit_width(value)) - 1;
  const auto within = static_cast<std::size_t>(value >> (octave - 5)) % bins_per_octave;
  const auto bin = static_cast<std::size_t>(octave) * bins_per_octave + within;
  ++bins_[std::min(bin, bins_.size() - 1)];
}

void DurationHistogram::merge(const DurationHistogram& other)
{
  count_ += other.count_;
  total_ += other.total_;
  least_ = std::min(least_, other.least_);
  most_ = std::max(most_, other.most_);
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) bins_[bin] += other.bins_[bin];
}

double DurationHistogram::quantile(double q) const
{
  const double wanted = q * static_cast<double>(count_);
  double seen = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    seen += bins_[bin];
    if (seen < wanted || bins_[bin] == 0) continue;
    const auto octave = static_cast<int>(bin / bins_per_octave);
    const double within = (static_cast<double>(bin % bins_per_octave) + 0.5) / bins_per_octave;
    const double middle = std::ldexp(1 + within, octave);
    return std::clamp(middle, static_cast<double>(least()), static_cast<double>(most_));
  }
  return static_cast<double>(most_);
}

Profiler::Profiler(const Schedule& schedule, BoundGraph& graph, int n_workers) : n_workers_(n_workers)
{
  steps_.first_tick = ticks();
  graph_ = nullptr;
  follow(schedule, graph);
}

void Profiler::follow(const Schedule& schedule, BoundGraph& graph)
{
  if (graph_ != nullptr) steps_.traffic = traffic();
  schedule_ = &schedule;
  graph_ = &graph;
  const TaskGraph& tasks = graph.graph();
  const auto n_patches = static_cast<std::size_t>(tasks.layout().size());
  path_.assign(tasks.instances().size(), 0);
  patch_costs_.assign(n_patches, 0);
  row_of_instance_.clear();
  for (const Instance& instance : tasks.instances()) {
    const std::string name = tasks.name(instance);
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.name == name; });
    if (row == rows_.end()) {
      row = rows_.insert(rows_.end(), Row{name, {}, std::vector<std::uint64_t>(instance.patch < 0 ? 1 : n_patches, 0)});
    }
    row_of_instance_.push_back(static_cast<std::size_t>(row - rows_.begin()));
  }
}

void Profiler::add_step()
{
  const auto& records = schedule_->records();
  const auto& instances = graph_->graph().instances();
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  std::uint64_t longest = 0;
  const bool traced = is_traced(n_steps_);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!graph_->is_local(static_cast<int>(i))) continue;
    const InstanceRecord& record = records[i];
    const std::uint64_t duration = record.end - record.start;
    std::uint64_t ready = 0;
    std::uint64_t path = 0;
    for (const int p : instances[i].predecessors) {
      ready = std::max(ready, records[static_cast<std::size_t>(p)].end);
      path = std::max(path, path_[static_cast<std::size_t>(p)]);
    }
    path_[i] = path + duration;
    longest = std::max(longest, path_[i]);
    first = std::min(first, record.start);
    last = std::max(last, record.end);

    const Instance& instance = instances[i];
    Row& row = rows_[row_of_instance_[i]];
    if (graph_->was_skipped(static_cast<int>(i))) {
      ++row.totals.skipped;
    } else {
      row.totals.durations.add(duration);
    }
    // Time stamps of two cores may differ by a little; a wait is never negative.
    if (ready != 0 && record.start > ready) row.totals.wait += record.start - ready;
    row.totals.bytes += static_cast<double>(graph_->bytes(static_cast<int>(i)));
    row.totals.particles += static_cast<double>(graph_->n_particles(static_cast<int>(i)));
    row.per_patch[static_cast<std::size_t>(std::max(0, instance.patch))] += duration;
    if (instance.patch >= 0) patch_costs_[static_cast<std::size_t>(instance.patch)] += static_cast<double>(duration);
    if (traced) traced_.push_back({row_of_instance_[i], instance.patch, instance.group, record});
  }
  ++n_steps_;
  if (last > first) steps_.ticks += last - first;
  steps_.path_ticks += longest;
}

/// All ranks know the whole graph, so that they trace the same steps.
bool Profiler::is_traced(long step) const
{
  const std::size_t n_instances = std::max<std::size_t>(graph_->graph().instances().size(), 1);
  return step < std::min(n_traced_steps_, static_cast<long>(most_traced / n_instances));
}

std::vector<double> Profiler::take_patch_costs()
{
  return std::exchange(patch_costs_, std::vector<double>(patch_costs_.size(), 0));
}

Traffic Profiler::traffic() const
{
  Traffic sum = steps_.traffic;
  sum.add(graph_->traffic());
  return sum;
}

/// The rows are the same on all ranks, as the graph is: only their numbers travel.
std::vector<Profiler::Row> Profiler::rows_of_all(const Communicator& communicator) const
{
  std::vector<std::byte> own;
  const auto add = [&](const auto* first, std::size_t n) {
    const auto bytes = std::as_bytes(std::span(first, n));
    own.insert(own.end(), bytes.begin(), bytes.end());
  };
  for (const Row& row : rows_) {
    add(&row.totals, 1);
    add(row.per_patch.data(), row.per_patch.size());
  }
  std::vector<Row> all = rows_;
  const auto from_each = communicator.gather(own);
  for (int rank = 0; rank < communicator.size(); ++rank) {
    if (rank == communicator.rank()) continue;
    const std::byte* from = from_each[static_cast<std::size_t>(rank)].data();
    for (Row& row : all) {
      Totals totals;
      std::vector<std::uint64_t> per_patch(row.per_patch.size());
      std::memcpy(&totals, from, sizeof totals);
      std::memcpy(per_patch.data(), from + sizeof totals, per_patch.size() * sizeof(std::uint64_t));
      from += sizeof totals + per_patch.size() * sizeof(std::uint64_t);
      row.totals.durations.merge(totals.durations);
      row.totals.skipped += totals.skipped;
      row.totals.wait += totals.wait;
      row.totals.bytes += totals.bytes;
      row.totals.particles += totals.particles;
      for (std::size_t p = 0; p < per_patch.size(); ++p) row.per_patch[p] += per_patch[p];
    }
  }
  return all;
}

TaskStatistics Profiler::statistics(const Row& row, std::uint64_t all_ticks, double second) const
{
  const DurationHistogram& durations = row.totals.durations;
  TaskStatistics t;
  t.name = row.name;
  t.count = durations.count();
  t.skipped = row.totals.skipped;
  t.total_s = static_cast<double>(durations.total()) * second;
  t.mean_s = t.count > 0 ? t.total_s / static_cast<double>(t.count) : 0;
  t.min_s = static_cast<double>(durations.least()) * second;
  t.max_s = static_cast<double>(durations.most()) * second;
  t.p95_s = durations.quantile(0.95) * second;
  t.share = static_cast<double>(durations.total()) / static_cast<double>(all_ticks);
  t.bytes = row.totals.bytes;
  t.particles = row.totals.particles;
  const double sum = static_cast<double>(std::accumulate(row.per_patch.begin(), row.per_patch.end(), std::uint64_t{0}));
  const double most = static_cast<double>(*std::max_element(row.per_patch.begin(), row.per_patch.end()));
  t.imbalance = sum > 0 ? most * static_cast<double>(row.per_patch.size()) / sum : 1;
  t.wait_s = static_cast<double>(row.totals.wait) * second;
  return t;
}

Profile Profiler::profile(const Communicator& communicator) const
{
  const double second = rate_.seconds_per_tick();
  Profile profile;
  profile.n_steps = n_steps_;
  while (profile.n_traced_steps < n_steps_ && is_traced(profile.n_traced_steps)) ++profile.n_traced_steps;
  const std::vector<Row> rows = rows_of_all(communicator);
  std::uint64_t all = 0;
  for (const Row& row : rows) all += row.totals.durations.total();
  for (const Row& row : rows) {
    if (row.totals.durations.count() + row.totals.skipped > 0) profile.tasks.push_back(statistics(row, all, second));
  }
  std::sort(profile.tasks.begin(), profile.tasks.end(),
            [](const TaskStatistics& a, const TaskStatistics& b) { return a.total_s > b.total_s; });

  Steps own = steps_;
  own.traffic = traffic();
  Steps together;
  together.first_tick = own.first_tick;
  std::uint64_t longest = 0;
  for (const Steps& steps : communicator.gather_value(own)) {
    together.first_tick = std::min(together.first_tick, steps.first_tick);
    together.ticks += steps.ticks;
    longest = std::max(longest, steps.ticks);
    together.path_ticks = std::max(together.path_ticks, steps.path_ticks);
    together.traffic.add(steps.traffic);
  }
  if (n_steps_ > 0) {
    profile.step_s = static_cast<double>(longest) * second / static_cast<double>(n_steps_);
    profile.critical_path_s = static_cast<double>(together.path_ticks) * second / static_cast<double>(n_steps_);
    profile.overhead = 1 - static_cast<double>(all) / (static_cast<double>(together.ticks) * n_workers_);
  }
  profile.n_messages = together.traffic.n_messages;
  profile.message_bytes = together.traffic.n_bytes;
  profile.message_s = static_cast<double>(together.traffic.under_way) * second;
  profile.message_wait_s = static_cast<double>(together.traffic.waited_for) * second;
  return profile;
}

Trace Profiler::trace(const Communicator& communicator) const
{
  const double second = rate_.seconds_per_tick();
  const std::uint64_t first_tick = communicator.min(steps_.first_tick);
  Trace trace;
  for (const Row& row : rows_) trace.tasks.push_back(row.name);
  const auto from_each = communicator.gather(std::as_bytes(std::span(traced_)));
  for (int rank = 0; rank < communicator.size(); ++rank) {
    const auto& bytes = from_each[static_cast<std::size_t>(rank)];
    std::vector<TracedInstance> traced(bytes.size() / sizeof(TracedInstance));
    if (!bytes.empty()) std::memcpy(static_cast<void*>(traced.data()), bytes.data(), bytes.size());
    const auto since_start = [&](std::uint64_t tick) { return static_cast<double>(tick - first_tick) * second; };
    for (const TracedInstance& t : traced) {
      trace.events.push_back(
          {t.row, rank, t.patch, t.group, t.record.worker, since_start(t.record.start), since_start(t.record.end)});
    }
  }
  return trace;
}

}  // namespace tamp::runtime
