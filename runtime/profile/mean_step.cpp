#include "runtime/profile/mean_step.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <deque>
#include <map>
#include <stdexcept>
#include <string>
#include <tuple>

namespace tamp::runtime
{

namespace
{

/// Task, patch, group, and rank; the rank only for instances that belong to a rank as a whole, as patches may have
/// moved since.
using InstanceKey = std::tuple<std::string, int, int, int>;

struct Times {
  double task_s = 0;
  double message_s = 0;
};

InstanceKey key_of(const std::string& task, int patch, int group, int rank)
{
  return {task, patch, group, patch < 0 ? rank : -1};
}

double seconds(const nlohmann::json& value)
{
  const double s = value.get<double>();
  if (!(s >= 0 && std::isfinite(s))) throw std::out_of_range("mean_step");
  return s;
}

/// Instances of one key, which several messages have, stand in the order of their graph.
std::map<InstanceKey, std::deque<Times>> times_in(const nlohmann::json& profile)
{
  std::map<InstanceKey, std::deque<Times>> times;
  for (const auto& [task, instances] : profile.at("mean_step").items()) {
    for (const nlohmann::json& i : instances) {
      times[key_of(task, i.at(0).get<int>(), i.at(1).get<int>(), i.at(2).get<int>())].push_back(
          {seconds(i.at(3)), seconds(i.at(4))});
    }
  }
  return times;
}

/// Whether a task is one that the engine adds to a step; a graph that is not run has none of them.
bool is_of_engine(const std::string& task)
{
  return task.ends_with("gather requests") || task.ends_with("combine: requests");
}

}  // namespace

nlohmann::json to_json(const std::vector<InstanceTime>& mean_step)
{
  nlohmann::json tasks = nlohmann::json::object();
  for (const InstanceTime& i : mean_step) {
    tasks[i.task].push_back({i.patch, i.group, i.rank, i.task_s, i.message_s});
  }
  return tasks;
}

std::optional<TimedStep> timed_step(const TaskGraph& graph, const nlohmann::json& profile)
{
  auto times = times_in(profile);
  TimedStep step{&graph, std::vector<double>(graph.instances().size(), 0),
                 std::vector<double>(graph.messages().size(), 0)};
  for (std::size_t k = 0; k < graph.instances().size(); ++k) {
    const Instance& instance = graph.instances()[k];
    const auto found = times.find(key_of(graph.name(instance), instance.patch, instance.group, instance.rank));
    if (found == times.end() || found->second.empty()) return std::nullopt;
    const Times next = found->second.front();
    found->second.pop_front();
    if (found->second.empty()) times.erase(found);
    step.instance_s[k] = next.task_s;
    if (instance.kind == InstanceKind::receive_message) {
      step.message_s[static_cast<std::size_t>(instance.message)] = next.message_s;
    }
  }
  if (!std::ranges::all_of(times, is_of_engine, [](const auto& left) { return std::get<0>(left.first); })) {
    return std::nullopt;
  }
  return step;
}

}  // namespace tamp::runtime
