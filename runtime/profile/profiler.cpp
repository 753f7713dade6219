#include "runtime/profile/profiler.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace tamp::runtime
{

Profiler::Profiler(const Schedule& schedule, BoundGraph& graph, int n_workers) : n_workers_(n_workers)
{
  steps_.first_tick = ticks();
  graph_ = nullptr;
  follow(schedule, graph);
}

void Profiler::follow(const Schedule& schedule, BoundGraph& graph)
{
  if (graph_ != nullptr) {
    steps_.traffic = traffic();
    add_patch_ticks(rows_);
  }
  schedule_ = &schedule;
  graph_ = &graph;
  const TaskGraph& tasks = graph.graph();
  const auto n_patches = static_cast<std::size_t>(tasks.layout().size());
  path_.assign(tasks.instances().size(), 0);
  instance_ticks_.assign(tasks.instances().size(), 0);
  n_followed_ = 0;
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
  waits_.make_room(rows_.size());
}

void Profiler::add_step()
{
  const std::uint64_t start = ticks();
  const std::uint64_t before = steps_.ticks;
  add_durations();
  if (looks_closely()) {
    look_closely();
    steps_.looked_at += steps_.ticks - before;
  }
  ++n_steps_;
  ++n_followed_;
  steps_.recording += ticks() - start;
}

void Profiler::add_durations()
{
  const auto& records = schedule_->records();
  const auto& instances = graph_->graph().instances();
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  const bool traced = is_traced(n_steps_);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!graph_->is_local(static_cast<int>(i))) continue;
    const InstanceRecord& record = records[i];
    const std::uint64_t duration = record.end - record.start;
    first = std::min(first, record.start);
    last = std::max(last, record.end);
    Totals& totals = rows_[row_of_instance_[i]].totals;
    if (graph_->was_skipped(static_cast<int>(i))) {
      ++totals.skipped;
    } else {
      totals.durations.add(duration);
    }
    instance_ticks_[i] += duration;
    const Instance& instance = instances[i];
    if (traced) traced_.push_back({row_of_instance_[i], instance.patch, instance.group, record});
  }
  if (last <= first) return;
  steps_.ticks += last - first;
  if (last_end_ != 0 && first > last_end_) steps_.between += first - last_end_;
  last_end_ = last;
}

void Profiler::look_closely()
{
  const auto& records = schedule_->records();
  const auto& instances = graph_->graph().instances();
  std::uint64_t longest = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!graph_->is_local(static_cast<int>(i))) continue;
    const InstanceRecord& record = records[i];
    std::uint64_t ready = 0;
    std::uint64_t path = 0;
    for (const int p : instances[i].predecessors) {
      ready = std::max(ready, records[static_cast<std::size_t>(p)].end);
      path = std::max(path, path_[static_cast<std::size_t>(p)]);
    }
    path_[i] = path + record.end - record.start;
    longest = std::max(longest, path_[i]);
    Totals& totals = rows_[row_of_instance_[i]].totals;
    // Time stamps of two cores may differ by a little; a delay is never negative.
    if (ready != 0 && record.start > ready) totals.ready_delay += record.start - ready;
    totals.processor_ns += record.processor_ns;
    if (n_steps_ > 0 && instances[i].patch >= 0) {
      patch_costs_[static_cast<std::size_t>(instances[i].patch)] += 1e-9 * record.processor_ns;
    }
    totals.bytes += static_cast<double>(graph_->bytes(static_cast<int>(i)));
    totals.particles += static_cast<double>(graph_->n_particles(static_cast<int>(i)));
  }
  waits_.add_step(*graph_, records, row_of_instance_);
  steps_.path_ticks += longest;
  ++n_looked_at_;
}

/// What each task took on each patch, of the steps since the graph is followed.
void Profiler::add_patch_ticks(std::vector<Row>& rows) const
{
  const auto& instances = graph_->graph().instances();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    rows[row_of_instance_[i]].per_patch[static_cast<std::size_t>(std::max(0, instances[i].patch))] +=
        instance_ticks_[i];
  }
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
  std::vector<Row> all = rows_;
  add_patch_ticks(all);
  std::vector<std::byte> own;
  const auto add = [&](const auto* first, std::size_t n) {
    const auto bytes = std::as_bytes(std::span(first, n));
    own.insert(own.end(), bytes.begin(), bytes.end());
  };
  for (const Row& row : all) {
    add(&row.totals, 1);
    add(row.per_patch.data(), row.per_patch.size());
  }
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
      row.totals.ready_delay += totals.ready_delay;
      row.totals.processor_ns += totals.processor_ns;
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
  const double of_all_steps = steps_for_each_looked_at();
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
  t.processor_s = 1e-9 * static_cast<double>(row.totals.processor_ns) * of_all_steps;
  t.bytes = row.totals.bytes * of_all_steps;
  t.particles = row.totals.particles * of_all_steps;
  const double sum = static_cast<double>(std::accumulate(row.per_patch.begin(), row.per_patch.end(), std::uint64_t{0}));
  const double most = static_cast<double>(*std::max_element(row.per_patch.begin(), row.per_patch.end()));
  t.imbalance = sum > 0 ? most * static_cast<double>(row.per_patch.size()) / sum : 1;
  t.ready_delay_s = static_cast<double>(row.totals.ready_delay) * second * time_for_each_looked_at();
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
  double path_share = 0;
  for (const Steps& steps : communicator.gather_value(own)) {
    together.first_tick = std::min(together.first_tick, steps.first_tick);
    together.ticks += steps.ticks;
    longest = std::max(longest, steps.ticks);
    together.recording = std::max(together.recording, steps.recording);
    together.between = std::max(together.between, steps.between);
    if (steps.looked_at > 0) {
      path_share = std::max(path_share, static_cast<double>(steps.path_ticks) / static_cast<double>(steps.looked_at));
    }
    together.traffic.add(steps.traffic);
  }
  if (n_steps_ > 0) {
    profile.step_s = static_cast<double>(longest) * second / static_cast<double>(n_steps_);
    profile.critical_path_s = path_share * profile.step_s;
    profile.recording_s = static_cast<double>(together.recording) * second / static_cast<double>(n_steps_);
    profile.between_s = static_cast<double>(together.between) * second / static_cast<double>(n_steps_);
    profile.overhead = 1 - static_cast<double>(all) / (static_cast<double>(together.ticks) * n_workers_);
  }
  profile.n_messages = together.traffic.n_messages;
  profile.message_bytes = together.traffic.n_bytes;
  profile.message_s = static_cast<double>(together.traffic.under_way) * second;
  profile.message_wait_s = static_cast<double>(together.traffic.waited_for) * second;
  profile.waits = waits(communicator, second);
  replay_mean_step(profile, communicator, second);
  return profile;
}

/// The longest of the waits between two tasks, over all ranks.
std::vector<Wait> Profiler::waits(const Communicator& communicator, double second) const
{
  constexpr std::size_t most = 10;
  const std::vector<std::uint64_t> all = communicator.sum(waits_.ticks());
  const std::size_t n = waits_.n_rows();
  std::vector<Wait> waits;
  for (std::size_t k = 0; k < all.size(); ++k) {
    if (all[k] == 0) continue;
    const std::string task = k / n < n ? rows_[k / n].name : "end of the step";
    waits.push_back({task, rows_[k % n].name, static_cast<double>(all[k]) * second * time_for_each_looked_at()});
  }
  std::sort(waits.begin(), waits.end(), [](const Wait& a, const Wait& b) { return a.total_s > b.total_s; });
  waits.resize(std::min(waits.size(), most));
  return waits;
}

double Profiler::steps_for_each_looked_at() const
{
  return n_looked_at_ > 0 ? static_cast<double>(n_steps_) / static_cast<double>(n_looked_at_) : 0;
}

double Profiler::time_for_each_looked_at() const
{
  return steps_.looked_at > 0 ? static_cast<double>(steps_.ticks) / static_cast<double>(steps_.looked_at) : 0;
}

/// Of all ranks, over the steps since patches were dealt last.
TimedStep Profiler::mean_step(const Communicator& communicator, double second) const
{
  const double to_mean = second / static_cast<double>(n_followed_);
  TimedStep step{&graph_->graph(), {}, {}};
  for (const std::uint64_t ticks : communicator.sum(instance_ticks_)) {
    step.instance_s.push_back(static_cast<double>(ticks) * to_mean);
  }
  for (const std::uint64_t ticks : communicator.sum(graph_->message_ticks())) {
    step.message_s.push_back(static_cast<double>(ticks) * to_mean);
  }
  return step;
}

/// Replays the mean step as it is, and with each of the dearest tasks faster: what is worth speeding up. The first
/// rank does that for all.
void Profiler::replay_mean_step(Profile& profile, const Communicator& communicator, double second) const
{
  if (n_followed_ == 0) return;
  const TimedStep mean = mean_step(communicator, second);
  if (!communicator.is_first()) return;
  const Chain chain = longest_chain(mean);
  profile.longest_chain_s = chain.length_s;
  const auto task = [&](std::size_t row) {
    return std::find_if(profile.tasks.begin(), profile.tasks.end(),
                        [&](const TaskStatistics& t) { return t.name == rows_[row].name; });
  };
  for (const int i : chain.instances) {
    const auto t = task(row_of_instance_[static_cast<std::size_t>(i)]);
    if (t != profile.tasks.end()) t->chain_s += mean.instance_s[static_cast<std::size_t>(i)];
  }
  // About a microsecond an instance: together some seconds at most.
  constexpr std::size_t most_instances = 4'000'000, most_tasks = 16;
  const std::size_t n_tasks = std::min(
      {profile.tasks.size(), most_tasks, most_instances / (2 * std::max<std::size_t>(mean.instance_s.size(), 1))});
  if (n_tasks == 0) return;
  profile.replayed_s = replay(mean, n_workers_);
  for (std::size_t k = 0; k < n_tasks; ++k) {
    TaskStatistics& t = profile.tasks[k];
    const auto gain = [&](double part) {
      TimedStep faster = mean;
      for (std::size_t i = 0; i < faster.instance_s.size(); ++i) {
        if (rows_[row_of_instance_[i]].name == t.name) faster.instance_s[i] *= 1 - part;
      }
      return 1 - replay(faster, n_workers_) / profile.replayed_s;
    };
    t.gain_of_tenth = gain(0.1);
    t.gain_of_all = gain(1);
  }
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
