#include "runtime/profile/profiler.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>

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

Profiler::Profiler(const Schedule& schedule, BoundGraph& graph, int n_workers, long n_traced_steps)
    : schedule_(schedule),
      graph_(graph),
      n_workers_(n_workers),
      n_traced_steps_(n_traced_steps),
      first_tick_(ticks()),
      path_(graph.graph().instances().size())
{
  const TaskGraph& tasks = graph.graph();
  for (const Instance& instance : tasks.instances()) {
    const std::string name = tasks.name(instance);
    auto row = std::find_if(rows_.begin(), rows_.end(), [&](const Row& r) { return r.name == name; });
    if (row == rows_.end()) {
      const auto n_patches = static_cast<std::size_t>(instance.patch < 0 ? 1 : tasks.layout().size());
      row = rows_.insert(rows_.end(), Row{name, {}, 0, 0, 0, std::vector<std::uint64_t>(n_patches, 0)});
    }
    row_of_instance_.push_back(static_cast<std::size_t>(row - rows_.begin()));
  }
}

void Profiler::add_step()
{
  const auto& records = schedule_.records();
  const auto& instances = graph_.graph().instances();
  std::uint64_t first = ~std::uint64_t{0};
  std::uint64_t last = 0;
  std::uint64_t longest = 0;
  for (std::size_t i = 0; i < records.size(); ++i) {
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

    Row& row = rows_[row_of_instance_[i]];
    row.durations.add(duration);
    // Time stamps of two cores may differ by a little; a wait is never negative.
    if (ready != 0 && record.start > ready) row.wait += record.start - ready;
    row.bytes += static_cast<double>(graph_.bytes(static_cast<int>(i)));
    row.particles += static_cast<double>(graph_.n_particles(static_cast<int>(i)));
    row.per_patch[static_cast<std::size_t>(std::max(0, instances[i].patch))] += duration;
    if (n_steps_ < n_traced_steps_) traced_.emplace_back(i, record);
  }
  ++n_steps_;
  step_ticks_ += last - first;
  path_ticks_ += longest;
}

Profile Profiler::profile() const
{
  const double second = rate_.seconds_per_tick();
  const auto seconds = [&](std::uint64_t ticks) { return static_cast<double>(ticks) * second; };
  Profile profile;
  profile.n_steps = n_steps_;
  std::uint64_t all = 0;
  for (const Row& row : rows_) all += row.durations.total();
  for (const Row& row : rows_) {
    if (row.durations.count() == 0) continue;
    TaskStatistics t;
    t.name = row.name;
    t.count = row.durations.count();
    t.total_s = seconds(row.durations.total());
    t.mean_s = t.total_s / static_cast<double>(t.count);
    t.min_s = seconds(row.durations.least());
    t.max_s = seconds(row.durations.most());
    t.p95_s = row.durations.quantile(0.95) * second;
    t.share = static_cast<double>(row.durations.total()) / static_cast<double>(all);
    t.bytes = row.bytes;
    t.particles = row.particles;
    const double sum =
        static_cast<double>(std::accumulate(row.per_patch.begin(), row.per_patch.end(), std::uint64_t{0}));
    const double most = static_cast<double>(*std::max_element(row.per_patch.begin(), row.per_patch.end()));
    t.imbalance = sum > 0 ? most * static_cast<double>(row.per_patch.size()) / sum : 1;
    t.wait_s = seconds(row.wait);
    profile.tasks.push_back(std::move(t));
  }
  std::sort(profile.tasks.begin(), profile.tasks.end(),
            [](const TaskStatistics& a, const TaskStatistics& b) { return a.total_s > b.total_s; });
  if (n_steps_ > 0) {
    profile.step_s = seconds(step_ticks_) / static_cast<double>(n_steps_);
    profile.critical_path_s = seconds(path_ticks_) / static_cast<double>(n_steps_);
    profile.overhead = 1 - static_cast<double>(all) / (static_cast<double>(step_ticks_) * n_workers_);
  }
  const auto& tasks = graph_.graph();
  for (const auto& [i, record] : traced_) {
    const Instance& instance = tasks.instances()[i];
    profile.trace.push_back({tasks.name(instance), instance.patch, instance.group, record.worker,
                             seconds(record.start - first_tick_), seconds(record.end - first_tick_)});
  }
  return profile;
}

}  // namespace tamp::runtime
