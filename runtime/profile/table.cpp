#include "runtime/profile/table.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace tamp::runtime
{

// Counts are read as floating-point numbers, as those of a damaged file need not fit into an integer.

namespace
{

/// A list of a profile; throws where it is none, which nlohmann would iterate over like an empty one.
const nlohmann::json::array_t& list_of(const nlohmann::json& profile, const char* key)
{
  return profile.at(key).get_ref<const nlohmann::json::array_t&>();
}

/// A share as percent; empty for profiles that do not have it.
std::string percent(const nlohmann::json& task, const char* key)
{
  const auto share = task.find(key);
  return share == task.end() ? "" : fmt::format("{:.1f}%", share->get<double>() * 100);
}

/// Rate per second, in units of `unit`; empty for a count of 0.
std::string rate(const nlohmann::json& task, const char* key, double unit)
{
  const double n = task.value(key, 0.0), seconds = task.at("total_s").get<double>();
  return n > 0 && seconds > 0 ? fmt::format("{:.3g}", n / seconds / unit) : "";
}

/// A task's bytes a second, in percent of those that memory gives a worker; empty where either is not known.
std::string of_memory(const nlohmann::json& task, double memory_rate)
{
  const double n = task.value("bytes", 0.0), seconds = task.at("total_s").get<double>();
  return n > 0 && seconds > 0 && memory_rate > 0 ? fmt::format("{:.0f}%", 100 * n / seconds / memory_rate) : "";
}

/// The column "of mem", which is left out where the rate of memory is not known.
std::string memory_column(const std::string& text, const TableChoice& choice)
{
  return choice.memory_rate > 0 ? fmt::format(" {:>7}", text) : "";
}

std::string header(const TableChoice& choice)
{
  return fmt::format("{:<32} {:>8} {:>9} {:>9} {:>7} {:>9} {:>8} {:>6}{} {:>13} {:>12} {:>12}\n", "task", "count",
                     "mean us", "p95 us", "share", "imbalance", "Mpart/s", "GB/s", memory_column("of mem", choice),
                     "critical path", "gain at -10%", "gain if free");
}

constexpr const char* glossary =
    "imbalance: costliest patch over the mean; critical path: share of steps whose longest chain of tasks goes through "
    "it; gain: of a step, if the task took 10% less, or no time\n";

std::string row(const nlohmann::json& t, const TableChoice& choice)
{
  return fmt::format("{:<32} {:>8.0f} {:>9.2f} {:>9.2f} {:>6.2f}% {:>9.3f} {:>8} {:>6}{} {:>13} {:>12} {:>12}\n",
                     t.at("name").get<std::string>(), t.at("count").get<double>(), t.at("mean_s").get<double>() * 1e6,
                     t.at("p95_s").get<double>() * 1e6, t.at("share").get<double>() * 100,
                     t.at("imbalance").get<double>(), rate(t, "particles", 1e6), rate(t, "bytes", 1e9),
                     memory_column(of_memory(t, choice.memory_rate), choice), percent(t, "on_chain"),
                     percent(t, "step_gain_if_a_tenth_faster"), percent(t, "step_gain_if_free"));
}

/// The rows of the chosen tasks, and what their columns mean.
std::string tasks_text(const nlohmann::json& profile, const TableChoice& choice)
{
  std::string text = header(choice);
  int n = 0;
  for (const nlohmann::json& t : list_of(profile, "tasks")) {
    if (!choice.phase.empty() && phase_of(t.at("name").get<std::string>()) != choice.phase) continue;
    if (choice.n_rows > 0 && n++ == choice.n_rows) break;
    text += row(t, choice);
  }
  return text + glossary;
}

double microseconds(const nlohmann::json& profile, const char* key)
{
  return profile.value(key, 0.0) * 1e6;
}

std::string messages_text(const nlohmann::json& profile)
{
  const auto n = profile.value("messages", 0.0);
  if (n == 0) return "";
  const double under_way = profile.at("message_s").get<double>();
  std::string text = fmt::format("{:.0f} messages between ranks, {:.1f} MiB", n,
                                 profile.at("message_bytes").get<double>() / (1024 * 1024));
  if (under_way > 0) {
    text += fmt::format(", {:.1f} us on their way, {:.0f} % of that hidden behind tasks", under_way / n * 1e6,
                        100 * (1 - profile.at("message_wait_s").get<double>() / under_way));
  }
  return text + "\n";
}

std::string waits_text(const nlohmann::json& profile)
{
  std::string text;
  for (const nlohmann::json& w : profile.value("waits", nlohmann::json::array())) {
    text += fmt::format("{:>10.2f} ms  {:<36} {}\n", w.at("s").get<double>() * 1e3, w.at("task").get<std::string>(),
                        w.at("waits_for").get<std::string>());
  }
  return text.empty() ? "" : "\nlongest waits of workers: for how long, before which task, for which other\n" + text;
}

/// Least, mean and largest time that all tasks of a rank take; empty for a single rank.
std::string ranks_text(const nlohmann::json& profile)
{
  const nlohmann::json ranks = profile.value("ranks", nlohmann::json::array());
  if (ranks.size() < 2) return "";
  std::vector<double> seconds;
  for (const nlohmann::json& rank : ranks) {
    double sum = 0;
    for (const nlohmann::json& t : rank.at("tasks")) sum += t.at("total_s").get<double>();
    seconds.push_back(sum);
  }
  const auto [least, most] = std::minmax_element(seconds.begin(), seconds.end());
  const double mean = std::accumulate(seconds.begin(), seconds.end(), 0.0) / static_cast<double>(seconds.size());
  return fmt::format("{} ranks: tasks of one take {:.4g} s at least, {:.4g} s on average, {:.4g} s at most (rank {})\n",
                     seconds.size(), *least, mean, *most, most - seconds.begin());
}

}  // namespace

std::string busy_text(const nlohmann::json& profile)
{
  if (!profile.value("too_busy", false)) return "";
  return fmt::format("too busy to trust: other programs had these cores for {:.0f} % of the time of tasks\n",
                     100 * (1 - profile.at("core_share").get<double>()));
}

std::string phase_of(const std::string& task)
{
  return task.substr(0, task.find(':'));
}

std::vector<std::string> phases_of(const nlohmann::json& profile)
{
  std::vector<std::string> phases;
  for (const nlohmann::json& t : list_of(profile, "tasks")) {
    const std::string phase = phase_of(t.at("name").get<std::string>());
    if (std::find(phases.begin(), phases.end(), phase) == phases.end()) phases.push_back(phase);
  }
  return phases;
}

std::string to_text(const nlohmann::json& profile, const TableChoice& choice)
{
  std::string text = tasks_text(profile, choice);
  text += fmt::format(
      "a step takes {:.1f} us on average, its longest chain of tasks {:.1f} us; scheduler overhead {:.2f} %; fields "
      "{:.1f} MiB\n",
      profile.at("step_s").get<double>() * 1e6,
      profile.value("longest_chain_s", profile.at("critical_path_s").get<double>()) * 1e6,
      profile.at("overhead").get<double>() * 100, profile.at("memory").at("total").get<double>() / (1024 * 1024));
  if (choice.memory_rate > 0) {
    text +=
        fmt::format("of mem: of what memory gives, {:.1f} GB/s to a worker while all use it; more comes from caches\n",
                    choice.memory_rate * 1e-9);
  }
  text += busy_text(profile) + messages_text(profile);
  if (choice.n_rows > 0 || !choice.phase.empty()) return text;
  if (profile.contains("replayed_s")) {
    text += fmt::format(
        "by replay it takes {:.1f} us; between two steps pass {:.1f} us, of which recording takes {:.1f} us\n",
        microseconds(profile, "replayed_s"), microseconds(profile, "between_s"), microseconds(profile, "recording_s"));
  }
  return text + ranks_text(profile) + waits_text(profile);
}

std::string rank_text(const nlohmann::json& profile, std::size_t rank, const TableChoice& choice)
{
  const nlohmann::json& own = profile.at("ranks").at(rank);
  return fmt::format("rank {}: a step takes {:.1f} us on average; scheduler overhead {:.2f} %\n", rank,
                     own.at("step_s").get<double>() * 1e6, own.at("overhead").get<double>() * 100) +
         tasks_text(own, choice);
}

std::string chain_text(const nlohmann::json& profile)
{
  std::string text = fmt::format("{:>9} {:>9}  {:<36} {:>6} {:>5}\n", "at us", "takes us", "task", "patch", "rank");
  double at = 0;
  for (const nlohmann::json& link : list_of(profile, "longest_chain")) {
    const double message = link.at("message_s").get<double>(), takes = link.at("s").get<double>();
    if (message > 0) text += fmt::format("{:>9.2f} {:>9.2f}  (message)\n", at * 1e6, message * 1e6);
    at += message;
    const double patch = link.at("patch").get<double>();
    text += fmt::format("{:>9.2f} {:>9.2f}  {:<36} {:>6} {:>5.0f}\n", at * 1e6, takes * 1e6,
                        link.at("task").get<std::string>(), patch < 0 ? "" : fmt::format("{:.0f}", patch),
                        link.at("rank").get<double>());
    at += takes;
  }
  return text + fmt::format(
                    "at: start in the mean step; takes: time of the task, or of the message before it\n"
                    "the longest chain takes {:.2f} us; a step takes {:.2f} us\n",
                    at * 1e6, profile.at("step_s").get<double>() * 1e6);
}

std::string patches_text(const nlohmann::json& profile, std::size_t n_rows)
{
  const auto& patches = list_of(profile, "patches");
  std::vector<std::size_t> order(patches.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  const auto seconds = [&](std::size_t p) { return patches.at(p).at("total_s").get<double>(); };
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return seconds(a) > seconds(b); });
  double sum = 0;
  for (const std::size_t p : order) sum += seconds(p);
  const double steps = std::max(profile.at("steps").get<double>(), 1.0);
  const double mean = patches.empty() ? 0 : sum / static_cast<double>(patches.size());
  std::string text =
      fmt::format("{:>7} {:>5} {:>10} {:>10}  {}\n", "patch", "rank", "us a step", "over mean", "costliest task");
  for (const std::size_t p : order) {
    if (n_rows-- == 0) break;
    text += fmt::format("{:>7} {:>5.0f} {:>10.2f} {:>10.3f}  {}\n", p, patches[p].at("rank").get<double>(),
                        seconds(p) / steps * 1e6, mean > 0 ? seconds(p) / mean : 1,
                        patches[p].at("dearest").get<std::string>());
  }
  const double median = order.empty() ? 0 : seconds(order[order.size() / 2]);
  return text + fmt::format(
                    "over mean: time of the patch over that of the mean patch; costliest task: the one with the most "
                    "of that time\n"
                    "{} patches: {:.2f} us a step on average, half of them {:.2f} us or less\n",
                    order.size(), mean / steps * 1e6, median / steps * 1e6);
}

}  // namespace tamp::runtime
