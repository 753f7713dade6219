#include "runtime/profile/report.hpp"

#include <fmt/format.h>

namespace tamp::runtime
{

nlohmann::json to_json(const Profile& profile, const MemoryLedger& ledger, const Communicator& communicator)
{
  nlohmann::json tasks = nlohmann::json::array();
  for (const TaskStatistics& t : profile.tasks) {
    tasks.push_back({{"name", t.name},
                     {"count", t.count},
                     {"skipped", t.skipped},
                     {"total_s", t.total_s},
                     {"mean_s", t.mean_s},
                     {"min_s", t.min_s},
                     {"max_s", t.max_s},
                     {"p95_s", t.p95_s},
                     {"share", t.share},
                     {"bytes", t.bytes},
                     {"particles", t.particles},
                     {"imbalance", t.imbalance},
                     {"wait_s", t.wait_s}});
  }
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

/// Counts are read as what a damaged file may have there, which need not fit into a whole number.
std::string to_text(const nlohmann::json& profile, int n_rows)
{
  std::string text = fmt::format("{:<36} {:>9} {:>10} {:>10} {:>7} {:>9} {:>10}\n", "task", "count", "mean us",
                                 "p95 us", "share", "imbalance", "wait ms");
  int row = 0;
  for (const nlohmann::json& t : profile.at("tasks")) {
    if (n_rows > 0 && row++ == n_rows) break;
    text += fmt::format(
        "{:<36} {:>9.0f} {:>10.2f} {:>10.2f} {:>6.2f}% {:>9.3f} {:>10.2f}\n", t.at("name").get<std::string>(),
        t.at("count").get<double>(), t.at("mean_s").get<double>() * 1e6, t.at("p95_s").get<double>() * 1e6,
        t.at("share").get<double>() * 100, t.at("imbalance").get<double>(), t.at("wait_s").get<double>() * 1e3);
  }
  text += fmt::format(
      "a step takes {:.1f} us in the mean, its longest chain of tasks {:.1f} us; scheduler overhead {:.2f} %; fields "
      "{:.1f} MiB\n",
      profile.at("step_s").get<double>() * 1e6, profile.at("critical_path_s").get<double>() * 1e6,
      profile.at("overhead").get<double>() * 100, profile.at("memory").at("total").get<double>() / (1024 * 1024));
  if (const auto n = profile.value("messages", 0.0); n > 0) {
    const double under_way = profile.at("message_s").get<double>();
    text += fmt::format(
        "{:.0f} messages between ranks, {:.1f} MiB, {:.1f} us on their way, {:.0f} % of that behind tasks\n", n,
        profile.at("message_bytes").get<double>() / (1024 * 1024), under_way / n * 1e6,
        100 * (1 - profile.at("message_wait_s").get<double>() / under_way));
  }
  return text;
}

}  // namespace tamp::runtime
