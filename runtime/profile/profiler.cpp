#include "runtime/profile/profiler.hpp"

#include <algorithm>
#include <cstring>
#include <numeric>
#include <utility>

namespace tamp::runtime
{

namespace
{

/// For each label the tasks that make it; each of several may make it for other groups.
std::map<std::string, std::string> makers_of(const TaskGraph& graph)
{
  std::map<std::string, std::string> makers;
  for (const TaskDeclaration& task : graph.declarations()) {
    for (const Access& access : task.accesses) {
      if (access.mode == Mode::read || access.mode == Mode::update) continue;
      std::string& names = makers[access.label->name()];
      names += (names.empty() ? "" : ", ") + task.name;
    }
  }
  return makers;
}

/// Category of an instance in a trace: the phase of a task ("task" if it names none), or the kind of the runtime's own
/// work.
std::string category(const TaskGraph& graph, const Instance& instance)
{
  switch (instance.kind) {
    case InstanceKind::body: {
      const std::string& phase = graph.declaration(instance).phase;
      return phase.empty() ? "task" : phase;
    }
    case InstanceKind::sum_halo:
    case InstanceKind::fill_halo:
      return "halo";
    case InstanceKind::combine:
      return "reduction";
    case InstanceKind::send_particles:
    case InstanceKind::receive_particles:
      return "migration";
    case InstanceKind::send_message:
    case InstanceKind::receive_message:
      return "message";
  }
  return "task";
}

}  // namespace

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
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const TaskRow& r) { return r.name == name; });
    if (row == rows_.end()) {
      const bool over_patches = instance.patch >= 0;
      row = rows_.insert(rows_.end(), TaskRow{name,
                                              category(tasks, instance),
                                              over_patches,
                                              {},
                                              std::vector<std::uint64_t>(over_patches ? n_patches : 1, 0)});
    }
    row_of_instance_.push_back(static_cast<std::size_t>(row - rows_.begin()));
  }
  waits_.make_room(rows_.size());
  on_chain_at_.resize(rows_.size(), 0);
  trace_.follow(graph, row_of_instance_);
}

void Profiler::trace_steps(const TraceChoice& choice, LedgerEntry& memory, const Communicator& communicator)
{
  held_by_trace_ = LedgerHold(memory, 0);
  trace_.choose(choice);
  if (choice.kind != TraceChoice::Kind::none) clock_at_begin_ = ask_first_rank(communicator);
}

void Profiler::add_step(const StepFacts& facts)
{
  const std::uint64_t start = ticks();
  const std::uint64_t before = steps_.ticks;
  if (parts_.outgrown_by(n_steps_)) {
    parts_.join_pairs();
    steps_.over_time.join_pairs();
    for (TaskRow& row : rows_) row.totals.over_time.join_pairs();
  }
  add_durations(facts);
  if (looks_closely()) {
    look_closely();
    steps_.looked_at += steps_.ticks - before;
  }
  if (takes_processor_time()) add_processor_times();
  ++n_steps_;
  ++n_followed_;
  steps_.recording += ticks() - start;
}

void Profiler::add_durations(const StepFacts& facts)
{
  const auto& records = schedule_->records();
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  const std::size_t part = parts_.part_of(n_steps_);
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!graph_->is_local(static_cast<int>(i))) continue;
    const InstanceRecord& record = records[i];
    const std::uint64_t duration = record.end - record.start;
    first = std::min(first, record.start);
    last = std::max(last, record.end);
    TaskTotals& totals = rows_[row_of_instance_[i]].totals;
    if (graph_->was_skipped(static_cast<int>(i))) {
      ++totals.skipped;
    } else {
      totals.durations.add(duration);
      totals.over_time.of_part[part] += duration;
    }
    instance_ticks_[i] += duration;
  }
  if (last <= first) last = first = last_end_;
  const double wall = static_cast<double>(last - first) * rate_.seconds_per_tick();
  trace_.add_step(facts, records, first, last, static_cast<float>(wall));
  held_by_trace_.hold(trace_.n_bytes());
  if (last == first) return;
  steps_.ticks += last - first;
  steps_.over_time.of_part[part] += last - first;
  if (last_end_ != 0 && first > last_end_) steps_.between += first - last_end_;
  last_end_ = last;
}

void Profiler::look_closely()
{
  const auto& records = schedule_->records();
  const auto& instances = graph_->graph().instances();
  std::uint64_t longest = 0;
  std::size_t last = 0;
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
    if (path_[i] > longest) {
      longest = path_[i];
      last = i;
    }
    TaskTotals& totals = rows_[row_of_instance_[i]].totals;
    // Time stamps of two cores may differ by a little; a delay is never negative.
    if (ready != 0 && record.start > ready) totals.ready_delay += record.start - ready;
    totals.bytes += static_cast<double>(graph_->bytes(static_cast<int>(i)));
    totals.particles += static_cast<double>(graph_->n_particles(static_cast<int>(i)));
  }
  waits_.add_step(*graph_, records, row_of_instance_);
  steps_.path_ticks += longest;
  ++n_looked_at_;
  if (longest > 0) follow_chain(last);
}

void Profiler::add_processor_times()
{
  const auto& records = schedule_->records();
  const auto& instances = graph_->graph().instances();
  for (std::size_t i = 0; i < records.size(); ++i) {
    if (!graph_->is_local(static_cast<int>(i))) continue;
    rows_[row_of_instance_[i]].totals.processor_ns += records[i].processor_ns;
    // Asking for it takes processor time, too, which may be more than a short task has.
    const double ns = static_cast<double>(records[i].end - records[i].start) * rate_.seconds_per_tick() * 1e9;
    steps_.sampled_ns += ns;
    steps_.processor_ns += std::min(ns, static_cast<double>(records[i].processor_ns));
    if (instances[i].patch < 0) continue;
    patch_costs_[static_cast<std::size_t>(instances[i].patch)] += 1e-9 * records[i].processor_ns;
  }
  ++n_processor_times_;
}

/// Notes the tasks of the longest chain, from its last instance back to its first.
void Profiler::follow_chain(std::size_t last)
{
  const auto& instances = graph_->graph().instances();
  for (std::size_t i = last;;) {
    const std::size_t row = row_of_instance_[i];
    if (on_chain_at_[row] != n_looked_at_) ++rows_[row].totals.on_chain;
    on_chain_at_[row] = n_looked_at_;
    const auto longer = [&](int a, int b) {
      return path_[static_cast<std::size_t>(a)] < path_[static_cast<std::size_t>(b)];
    };
    const auto& before = instances[i].predecessors;
    const auto next = std::max_element(before.begin(), before.end(), longer);
    if (next == before.end() || path_[static_cast<std::size_t>(*next)] == 0) return;
    i = static_cast<std::size_t>(*next);
  }
}

/// Adds the ticks that each task took on each patch since the graph is followed.
void Profiler::add_patch_ticks(std::vector<TaskRow>& rows) const
{
  const auto& instances = graph_->graph().instances();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    rows[row_of_instance_[i]].per_patch[static_cast<std::size_t>(std::max(0, instances[i].patch))] +=
        instance_ticks_[i];
  }
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

Profile Profiler::profile(const Communicator& communicator) const
{
  const double second = rate_.seconds_per_tick();
  Profile profile;
  profile.n_steps = n_steps_;
  profile.n_traced_steps = static_cast<long>(trace_.n_steps());
  Steps own = steps_;
  own.traffic = traffic();
  own.in_tasks = ticks_of(rows_);
  add_tasks(profile, communicator, second);
  add_steps(profile, communicator.gather_value(own), second);
  profile.waits = waits(communicator, second);
  replay_mean_step(profile, communicator, second);
  profile.makers = makers_of(graph_->graph());
  return profile;
}

void Profiler::add_tasks(Profile& profile, const Communicator& communicator, double second) const
{
  std::vector<TaskRow> own = rows_;
  add_patch_ticks(own);
  const std::vector<int> rank_of_patch = graph_->graph().layout().ranks();
  RowScales scales{0,
                   second,
                   steps_for_each(n_looked_at_),
                   steps_for_each(n_processor_times_),
                   time_for_each_looked_at(),
                   static_cast<double>(n_looked_at_)};
  std::vector<TaskRow> all;
  std::vector<std::uint64_t> busiest(own.size(), 0);
  for_each_rank(own, communicator, [&](int rank, const std::vector<TaskRow>& rows) {
    scales.all_ticks = ticks_of(rows);
    scales.rank = rank;
    profile.ranks.push_back({statistics(rows, scales, rank_of_patch)});
    if (rank == 0) all = rows;
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (rank > 0) all[k].add(rows[k]);
      busiest[k] = std::max(busiest[k], rows[k].totals.durations.total());
    }
  });
  scales.all_ticks = ticks_of(all);
  scales.rank = -1;
  scales.looked_at *= communicator.size();
  profile.tasks = statistics(all, scales, rank_of_patch);
  profile.patches = patch_statistics(all, rank_of_patch, second);
  for (TaskStatistics& t : profile.tasks) {
    const auto row = static_cast<std::size_t>(std::ranges::find(all, t.name, &TaskRow::name) - all.begin());
    t.over_time_s = per_step(all[row].totals.over_time, second);
    if (t.total_s > 0) t.rank_imbalance = static_cast<double>(busiest[row]) * second * communicator.size() / t.total_s;
  }
}

/// Mean time per step [s] in each part of the run.
std::vector<double> Profiler::per_step(const TicksOverTime& ticks, double second) const
{
  std::vector<double> seconds;
  seconds.reserve(RunParts::most);
  for (const long n : parts_.steps_of_parts(n_steps_)) {
    seconds.push_back(static_cast<double>(ticks.of_part[seconds.size()]) * second / static_cast<double>(n));
  }
  return seconds;
}

void Profiler::add_steps(Profile& profile, const std::vector<Steps>& of_ranks, double second) const
{
  const double to_mean = n_steps_ > 0 ? second / static_cast<double>(n_steps_) : 0;
  // Times of one rank, so that they add up to what passed there.
  const Steps& busiest = *std::ranges::max_element(of_ranks, {}, &Steps::ticks);
  Steps sum;
  double path_share = 0;
  for (std::size_t r = 0; r < of_ranks.size(); ++r) {
    const Steps& steps = of_ranks[r];
    profile.ranks[r].step_s = static_cast<double>(steps.ticks) * to_mean;
    profile.ranks[r].between_s = static_cast<double>(steps.between) * to_mean;
    profile.ranks[r].overhead = overhead(steps);
    sum.ticks += steps.ticks;
    sum.in_tasks += steps.in_tasks;
    sum.traffic.add(steps.traffic);
    sum.sampled_ns += steps.sampled_ns;
    sum.processor_ns += steps.processor_ns;
    if (steps.looked_at == 0) continue;
    path_share = std::max(path_share, static_cast<double>(steps.path_ticks) / static_cast<double>(steps.looked_at));
  }
  profile.step_s = static_cast<double>(busiest.ticks) * to_mean;
  profile.steps_each_part = parts_.steps_each();
  profile.step_over_time_s = per_step(busiest.over_time, second);
  profile.critical_path_s = path_share * profile.step_s;
  profile.recording_s = static_cast<double>(busiest.recording) * to_mean;
  profile.between_s = static_cast<double>(busiest.between) * to_mean;
  profile.overhead = overhead(sum);
  if (n_processor_times_ >= least_samples) profile.core_share = sum.processor_ns / sum.sampled_ns;
  profile.n_messages = sum.traffic.n_messages;
  profile.message_bytes = sum.traffic.n_bytes;
  profile.message_s = static_cast<double>(sum.traffic.under_way) * second;
  profile.message_wait_s = static_cast<double>(sum.traffic.waited_for) * second;
}

/// The part of the workers' time in steps that is outside of tasks.
double Profiler::overhead(const Steps& steps) const
{
  if (steps.ticks == 0) return 0;
  return 1 - static_cast<double>(steps.in_tasks) / (static_cast<double>(steps.ticks) * n_workers_);
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

double Profiler::steps_for_each(long n_samples) const
{
  return n_samples > 0 ? static_cast<double>(n_steps_) / static_cast<double>(n_samples) : 0;
}

double Profiler::time_for_each_looked_at() const
{
  return steps_.looked_at > 0 ? static_cast<double>(steps_.ticks) / static_cast<double>(steps_.looked_at) : 0;
}

/// The mean step of all ranks, over the steps since patches were dealt last.
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

/// A step with each run of a task taking `factor` times as long.
TimedStep Profiler::changed(TimedStep step, const std::string& task, double factor) const
{
  for (std::size_t i = 0; i < step.instance_s.size(); ++i) {
    if (rows_[row_of_instance_[i]].name == task) step.instance_s[i] *= factor;
  }
  return step;
}

double Profiler::step_ratio(const std::string& task, double factor, const Communicator& communicator) const
{
  if (n_followed_ == 0) return 1;
  const TimedStep mean = mean_step(communicator, rate_.seconds_per_tick());
  if (!communicator.is_first()) return 1;
  return replay(changed(mean, task, factor), n_workers_) / replay(mean, n_workers_);
}

std::vector<InstanceTime> Profiler::times_of(const TimedStep& step) const
{
  constexpr std::size_t most_instances = 20'000;
  const auto& instances = step.graph->instances();
  std::vector<InstanceTime> times;
  if (instances.size() > most_instances) return times;
  times.reserve(instances.size());
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    const bool receives = instance.kind == InstanceKind::receive_message;
    times.push_back({rows_[row_of_instance_[i]].name, instance.patch, instance.group, instance.rank, step.instance_s[i],
                     receives ? step.message_s[static_cast<std::size_t>(instance.message)] : 0});
  }
  return times;
}

/// Replays the mean step as it is, and with each of the dearest tasks faster: what is worth speeding up. The first
/// rank does that for all.
void Profiler::replay_mean_step(Profile& profile, const Communicator& communicator, double second) const
{
  if (n_followed_ == 0) return;
  const TimedStep mean = mean_step(communicator, second);
  if (!communicator.is_first()) return;
  profile.mean_step = times_of(mean);
  const Chain chain = longest_chain(mean);
  profile.longest_chain_s = chain.length_s;
  const auto task = [&](std::size_t row) {
    return std::find_if(profile.tasks.begin(), profile.tasks.end(),
                        [&](const TaskStatistics& t) { return t.name == rows_[row].name; });
  };
  profile.chain.reserve(chain.instances.size());
  for (std::size_t k = 0; k < chain.instances.size(); ++k) {
    const auto i = static_cast<std::size_t>(chain.instances[k]);
    const Instance& instance = mean.graph->instances()[i];
    profile.chain.push_back(
        {rows_[row_of_instance_[i]].name, instance.patch, instance.rank, mean.instance_s[i], chain.message_s[k]});
    const auto t = task(row_of_instance_[i]);
    if (t != profile.tasks.end()) t->chain_s += mean.instance_s[i];
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
      return 1 - replay(changed(mean, t.name, 1 - part), n_workers_) / profile.replayed_s;
    };
    t.gain_of_tenth = gain(0.1);
    t.gain_of_all = gain(1);
  }
}

Trace Profiler::trace(const Communicator& communicator) const
{
  Trace trace;
  trace.tasks.reserve(rows_.size());
  for (const TaskRow& row : rows_) trace.tasks.push_back({row.name, row.category});
  trace.groups = graph_->graph().group_names();
  if (trace_.choice().kind == TraceChoice::Kind::none) return trace;
  const ClockLine clock(clock_at_begin_, ask_first_rank(communicator));
  trace.ranks = gather_tapes(trace_.tape(communicator), clock, n_workers_, communicator);
  trace.begin = steps_.first_tick;
  trace.second = rate_.seconds_per_tick();
  return trace;
}

}  // namespace tamp::runtime
