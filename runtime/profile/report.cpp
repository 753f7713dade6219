#include "runtime/profile/report.hpp"

#include <fmt/format.h>

#include <cmath>

#include "runtime/profile/mean_step.hpp"

namespace tamp::runtime
{

namespace
{

/// The keys that a task has both in the run as a whole and on each rank.
nlohmann::json to_json(const TaskStatistics& t)
{
  nlohmann::json json = {{"name", t.name},           {"count", t.count},
                         {"skipped", t.skipped},     {"total_s", t.total_s},
                         {"mean_s", t.mean_s},       {"min_s", t.min_s},
                         {"max_s", t.max_s},         {"p95_s", t.p95_s},
                         {"share", t.share},         {"bytes", t.bytes},
                         {"particles", t.particles}, {"imbalance", t.imbalance},
                         {"on_chain", t.on_chain},   {"ready_delay_s", t.ready_delay_s}};
  if (std::isfinite(t.processor_s)) json["processor_s"] = t.processor_s;
  return json;
}

nlohmann::json to_json(const std::vector<TaskStatistics>& tasks)
{
  nlohmann::json list = nlohmann::json::array();
  for (const TaskStatistics& t : tasks) list.push_back(to_json(t));
  return list;
}

/// The tasks, with the keys that only the run as a whole has.
nlohmann::json tasks_of_run(const std::vector<TaskStatistics>& tasks)
{
  nlohmann::json list = to_json(tasks);
  for (std::size_t k = 0; k < tasks.size(); ++k) {
    const TaskStatistics& t = tasks[k];
    list[k].update({{"chain_s", t.chain_s}, {"rank_imbalance", t.rank_imbalance}, {"over_time_s", t.over_time_s}});
    // The old name of `ready_delay_s`, for one release.
    list[k]["wait_s"] = t.ready_delay_s;
    if (!std::isfinite(t.gain_of_all)) continue;
    list[k]["step_gain_if_a_tenth_faster"] = t.gain_of_tenth;
    list[k]["step_gain_if_free"] = t.gain_of_all;
  }
  return list;
}

/// Each rank with its tasks.
nlohmann::json to_json(const std::vector<RankStatistics>& ranks)
{
  nlohmann::json list = nlohmann::json::array();
  for (const RankStatistics& rank : ranks) {
    list.push_back({{"step_s", rank.step_s},
                    {"between_s", rank.between_s},
                    {"overhead", rank.overhead},
                    {"tasks", to_json(rank.tasks)}});
  }
  return list;
}

nlohmann::json to_json(const std::vector<ChainLink>& chain)
{
  nlohmann::json list = nlohmann::json::array();
  for (const ChainLink& link : chain) {
    list.push_back({{"task", link.task},
                    {"patch", link.patch},
                    {"rank", link.rank},
                    {"s", link.task_s},
                    {"message_s", link.message_s}});
  }
  return list;
}

nlohmann::json to_json(const std::vector<PatchStatistics>& patches)
{
  nlohmann::json list = nlohmann::json::array();
  for (const PatchStatistics& patch : patches) {
    list.push_back({{"rank", patch.rank}, {"total_s", patch.total_s}, {"dearest", patch.dearest}});
  }
  return list;
}

/// The most that each label held; what each held when all together held the most; and the same by the tasks that make
/// the labels.
nlohmann::json to_json(const MemoryLedger& ledger, const std::map<std::string, std::string>& makers,
                       const Communicator& communicator)
{
  nlohmann::json labels = nlohmann::json::object(), at_high_water = labels;
  std::map<std::string, std::uint64_t> tasks;
  for (const LedgerEntry& entry : ledger.entries()) {
    const std::uint64_t then = communicator.sum(entry.at_high_water());
    labels[entry.name()] = communicator.sum(entry.peak());
    at_high_water[entry.name()] = then;
    const auto maker = makers.find(entry.name());
    tasks[maker == makers.end() ? "(no task of a step)" : maker->second] += then;
  }
  return {{"labels", labels},
          {"at_high_water", at_high_water},
          {"tasks", tasks},
          {"total", communicator.sum(ledger.total().peak())}};
}

}  // namespace

nlohmann::json to_json(const Profile& profile, const MemoryLedger& ledger, const Communicator& communicator)
{
  nlohmann::json waits = nlohmann::json::array();
  for (const Wait& w : profile.waits) waits.push_back({{"task", w.task}, {"waits_for", w.cause}, {"s", w.total_s}});
  nlohmann::json json = {{"tasks", tasks_of_run(profile.tasks)},
                         {"ranks", to_json(profile.ranks)},
                         {"patches", to_json(profile.patches)},
                         {"over_time", {{"steps_each", profile.steps_each_part}, {"step_s", profile.step_over_time_s}}},
                         {"steps", profile.n_steps},
                         {"traced_steps", profile.n_traced_steps},
                         {"overhead", profile.overhead},
                         {"critical_path_s", profile.critical_path_s},
                         {"step_s", profile.step_s},
                         {"longest_chain_s", profile.longest_chain_s},
                         {"longest_chain", to_json(profile.chain)},
                         {"mean_step", to_json(profile.mean_step)},
                         {"replayed_s", profile.replayed_s},
                         {"recording_s", profile.recording_s},
                         {"between_s", profile.between_s},
                         {"waits", waits},
                         {"messages", profile.n_messages},
                         {"message_bytes", profile.message_bytes},
                         {"message_s", profile.message_s},
                         {"message_wait_s", profile.message_wait_s},
                         {"memory", to_json(ledger, profile.makers, communicator)}};
  if (std::isfinite(profile.core_share)) {
    json.update({{"core_share", profile.core_share}, {"too_busy", is_too_busy(profile.core_share)}});
  }
  return json;
}

}  // namespace tamp::runtime
