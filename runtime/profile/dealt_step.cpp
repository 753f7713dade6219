#include "runtime/profile/dealt_step.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <set>

namespace tamp::runtime
{

namespace
{

std::vector<int> levels_of(const TaskGraph& graph)
{
  std::vector<int> level(graph.instances().size(), 0), n_in_level;
  for (std::size_t i = 0; i < level.size(); ++i) {
    for (const int p : graph.instances()[i].predecessors) {
      level[i] = std::max(level[i], level[static_cast<std::size_t>(p)] + 1);
    }
    n_in_level.resize(std::max(n_in_level.size(), static_cast<std::size_t>(level[i]) + 1), 0);
    ++n_in_level[static_cast<std::size_t>(level[i])];
  }
  return n_in_level;
}

std::string share_text(const ThreadShare& share, double mean_s)
{
  std::string text =
      fmt::format("{:>6} {:>7} {:>8} {:>10}", share.rank, share.thread, share.n_patches, share.n_instances);
  if (mean_s > 0) text += fmt::format(" {:>10.2f} {:>10.3f}", share.work_s * 1e6, share.work_s / mean_s);
  return text + "\n";
}

/// Powers of two below `last`, and that.
std::vector<int> doubled_up_to(int last)
{
  std::vector<int> numbers;
  for (int n = 1; n < last; n *= 2) numbers.push_back(n);
  numbers.push_back(last);
  return numbers;
}

}  // namespace

DealtStep deal_to_threads(const TaskGraph& graph, int n_threads)
{
  return deal_to_threads(TimedStep{&graph, std::vector<double>(graph.instances().size(), 0), {}}, n_threads);
}

DealtStep deal_to_threads(const TimedStep& step, int n_threads)
{
  const TaskGraph& graph = *step.graph;
  DealtStep dealt{n_threads, {}, levels_of(graph)};
  for (int rank = 0; rank < graph.layout().n_ranks(); ++rank) {
    for (int thread = 0; thread < n_threads; ++thread) dealt.shares.push_back({rank, thread});
  }
  const std::vector<int> homes = homes_of(graph, n_threads);
  std::vector<std::set<int>> patches(dealt.shares.size());
  for (std::size_t i = 0; i < homes.size(); ++i) {
    const auto home = static_cast<std::size_t>(homes[i]);
    ++dealt.shares[home].n_instances;
    dealt.shares[home].work_s += step.instance_s[i];
    if (graph.instances()[i].patch >= 0) patches[home].insert(graph.instances()[i].patch);
  }
  for (std::size_t h = 0; h < patches.size(); ++h) dealt.shares[h].n_patches = static_cast<int>(patches[h].size());
  return dealt;
}

std::string to_text(const DealtStep& dealt)
{
  const auto work = [](double sum, const ThreadShare& share) { return sum + share.work_s; };
  const double mean_s = std::accumulate(dealt.shares.begin(), dealt.shares.end(), 0.0, work) /
                        static_cast<double>(std::max<std::size_t>(dealt.shares.size(), 1));
  std::string text = fmt::format("{:>6} {:>7} {:>8} {:>10}", "rank", "thread", "patches", "instances");
  if (mean_s > 0) text += fmt::format(" {:>10} {:>10}", "us a step", "over mean");
  text += "\n";
  for (const ThreadShare& share : dealt.shares) text += share_text(share, mean_s);
  const int n = std::accumulate(dealt.levels.begin(), dealt.levels.end(), 0);
  const auto n_levels = static_cast<int>(dealt.levels.size());
  const int widest = n_levels > 0 ? *std::ranges::max_element(dealt.levels) : 0;
  const auto n_all = static_cast<int>(dealt.shares.size());
  const auto n_narrow = std::ranges::count_if(dealt.levels, [&](int width) { return width < n_all; });
  return text + fmt::format(
                    "{} instances in {} levels, {:.1f} on average and {} at most; {} levels are narrower than "
                    "the {} threads\n",
                    n, n_levels, n_levels > 0 ? static_cast<double>(n) / n_levels : 0.0, widest, n_narrow, n_all);
}

std::string replays_text(const TimedStep& step, int n_threads, int n_measured, double measured_s)
{
  const double one_s = replay(step, 1);
  std::string text = fmt::format("{:>7} {:>12} {:>8} {:>10}\n", "threads", "us by replay", "speed-up", "efficiency");
  for (const int n : doubled_up_to(n_threads)) {
    const double s = replay(step, n);
    text += fmt::format("{:>7} {:>12.1f} {:>8.2f} {:>10.2f}\n", n, s * 1e6, one_s / s, one_s / s / n);
  }
  return text + fmt::format(
                    "the longest chain takes {:.1f} us: no number of threads is faster; a measured step takes {:.1f} "
                    "us on {}, by replay {:.1f} us\n",
                    longest_chain(step).length_s * 1e6, measured_s * 1e6, n_measured, replay(step, n_measured) * 1e6);
}

}  // namespace tamp::runtime
