#include "runtime/profile/report.hpp"

#include <fmt/format.h>

#include <cmath>

namespace tamp::runtime
{

namespace
{

nlohmann::json to_json(const TaskStatistics& t)
{
  nlohmann::json json = {{"name", t.name},           {"count", t.count},
                         {"skipped", t.skipped},     {"total_s", t.total_s},
                         {"mean_s", t.mean_s},       {"min_s", t.min_s},
                         {"max_s", t.max_s},         {"p95_s", t.p95_s},
                         {"share", t.share},         {"processor_s", t.processor_s},
                         {"bytes", t.bytes},         {"particles", t.particles},
                         {"imbalance", t.imbalance}, {"ready_delay_s", t.ready_delay_s},
                         {"chain_s", t.chain_s}};
  // The old name of `ready_delay_s`, for one release.
  json["wait_s"] = t.ready_delay_s;
  if (std::isfinite(t.gain_of_all)) {
    json["step_gain_if_a_tenth_faster"] = t.gain_of_tenth;
    json["step_gain_if_free"] = t.gain_of_all;
  }
  return json;
}

}  // namespace

nlohmann::json to_json(const Profile& profile, const MemoryLedger& ledger, const Communicator& communicator)
{
  nlohmann::json tasks = nlohmann::json::array();
  for (const TaskStatistics& t : profile.tasks) tasks.push_back(to_json(t));
  nlohmann::json waits = nlohmann::json::array();
  for (const Wait& w : profile.waits) waits.push_back({{"task", w.task}, {"waits_for", w.cause}, {"s", w.total_s}});
  nlohmann::json labels = nlohmann::json::object();
  for (const LedgerEntry& entry : ledger.entries()) {
    labels[entry.name()] = communicator.sum(static_cast<std::uint64_t>(entry.peak()));
  }
  const std::size_t total = communicator.sum(static_cast<std::uint64_t>(ledger.total().peak()));
  return {{"tasks", tasks},
          {"steps", profile.n_steps},
          {"traced_steps", profile.n_traced_steps},
          {"overhead", profile.overhead},
          {"critical_path_s", profile.critical_path_s},
          {"step_s", profile.step_s},
          {"longest_chain_s", profile.longest_chain_s},
          {"replayed_s", profile.replayed_s},
          {"recording_s", profile.recording_s},
          {"between_s", profile.between_s},
          {"waits", waits},
          {"messages", profile.n_messages},
          {"message_bytes", profile.message_bytes},
          {"message_s", profile.message_s},
          {"message_wait_s", profile.message_wait_s},
          {"memory", {{"labels", labels}, {"total", total}}}};
}

void write_trace(const Trace& trace, const std::function<void(std::string_view)>& write)
{
  constexpr double microseconds = 1e6;
  std::vector<std::string> names;
  for (const std::string& task : trace.tasks) names.push_back(nlohmann::json(task).dump());
  write(R"({"displayTimeUnit":"ns","traceEvents":[)");
  const char* before = "\n";
  for (const TraceEvent& e : trace.events) {
    write(fmt::format(
        R"({}{{"name":{},"ph":"X","pid":{},"tid":{},"ts":{:.3f},"dur":{:.3f},"args":{{"patch":{},"group":{}}}}})",
        before, names[e.task], e.rank, e.worker, e.start_s * microseconds, (e.end_s - e.start_s) * microseconds,
        e.patch, e.group));
    before = ",\n";
  }
  write("]}\n");
}

namespace
{

/// What a step would gain, as percent; of profiles that do not say, nothing.
std::string percent(const nlohmann::json& task, const char* key)
{
  const auto gain = task.find(key);
  return gain == task.end() ? "" : fmt::format("{:.1f}%", gain->get<double>() * 100);
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
  return fmt::format(
      "{:.0f} messages between ranks, {:.1f} MiB, {:.1f} us on their way, {:.0f} % of that behind tasks\n", n,
      profile.at("message_bytes").get<double>() / (1024 * 1024), under_way / n * 1e6,
      100 * (1 - profile.at("message_wait_s").get<double>() / under_way));
}

std::string waits_text(const nlohmann::json& profile)
{
  std::string text;
  for (const nlohmann::json& w : profile.value("waits", nlohmann::json::array())) {
    text += fmt::format("{:>10.2f} ms  {:<36} for {}\n", w.at("s").get<double>() * 1e3, w.at("task").get<std::string>(),
                        w.at("waits_for").get<std::string>());
  }
  return text.empty() ? "" : "\nworkers stood still longest before\n" + text;
}

}  // namespace

/// Counts are read as what a damaged file may have there, which need not fit into a whole number.
std::string to_text(const nlohmann::json& profile, int n_rows)
{
  std::string text = fmt::format("{:<36} {:>9} {:>9} {:>9} {:>7} {:>9} {:>9} {:>8}\n", "task", "count", "mean us",
                                 "p95 us", "share", "imbalance", "10% less", "if free");
  int row = 0;
  for (const nlohmann::json& t : profile.at("tasks")) {
    if (n_rows > 0 && row++ == n_rows) break;
    text += fmt::format("{:<36} {:>9.0f} {:>9.2f} {:>9.2f} {:>6.2f}% {:>9.3f} {:>9} {:>8}\n",
                        t.at("name").get<std::string>(), t.at("count").get<double>(),
                        t.at("mean_s").get<double>() * 1e6, t.at("p95_s").get<double>() * 1e6,
                        t.at("share").get<double>() * 100, t.at("imbalance").get<double>(),
                        percent(t, "step_gain_if_a_tenth_faster"), percent(t, "step_gain_if_free"));
  }
  text += fmt::format(
      "a step takes {:.1f} us in the mean, its longest chain of tasks {:.1f} us; scheduler overhead {:.2f} %; fields "
      "{:.1f} MiB\n",
      profile.at("step_s").get<double>() * 1e6,
      profile.value("longest_chain_s", profile.at("critical_path_s").get<double>()) * 1e6,
      profile.at("overhead").get<double>() * 100, profile.at("memory").at("total").get<double>() / (1024 * 1024));
  text += messages_text(profile);
  if (n_rows > 0) return text;
  if (profile.contains("replayed_s")) {
    text += fmt::format(
        "replayed, it takes {:.1f} us; between two steps pass {:.1f} us, {:.1f} us of it to record them\n",
        microseconds(profile, "replayed_s"), microseconds(profile, "between_s"), microseconds(profile, "recording_s"));
  }
  return text + waits_text(profile);
}

}  // namespace tamp::runtime
