#include "runtime/graph/dump.hpp"

#include <fmt/format.h>

#include <map>
#include <set>

namespace tamp::runtime
{

namespace
{

nlohmann::json labels_in(const TaskGraph& graph, const Instance& instance, Mode mode)
{
  nlohmann::json labels = nlohmann::json::array();
  if (instance.kind != InstanceKind::body) {
    const Mode own = instance.kind == InstanceKind::combine ? Mode::compute : Mode::update;
    for (const Label* label : instance.labels) {
      if (mode == own) labels.push_back({{"label", label->name()}, {"halo", instance.halo}});
    }
    return labels;
  }
  for (const Access& access : graph.declaration(instance).accesses) {
    if (access.mode != mode) continue;
    labels.push_back({{"label", access.label->name()},
                      {"centring", to_string(access.label->centring())},
                      {"halo", access.halo},
                      {"step", access.of_previous_step ? "previous" : "current"}});
  }
  return labels;
}

nlohmann::json group_name(const TaskGraph& graph, const Instance& instance)
{
  if (instance.group < 0) return nullptr;
  return graph.group_names()[static_cast<std::size_t>(instance.group)];
}

std::string dot_node(const TaskGraph& graph, std::size_t i)
{
  const Instance& instance = graph.instances()[i];
  const std::string group =
      instance.group < 0 ? "" : "\\n" + graph.group_names()[static_cast<std::size_t>(instance.group)];
  const char* shape = instance.kind == InstanceKind::body ? "box" : "ellipse";
  return fmt::format("    t{} [label=\"{}{}\", shape={}];\n", i, graph.name(instance), group, shape);
}

}  // namespace

nlohmann::json to_json(const TaskGraph& graph, std::size_t forecast_bytes)
{
  nlohmann::json tasks = nlohmann::json::array();
  const auto& instances = graph.instances();
  for (std::size_t i = 0; i < instances.size(); ++i) {
    const Instance& instance = instances[i];
    nlohmann::json task = {{"id", i},
                           {"name", graph.name(instance)},
                           {"patch", instance.patch},
                           {"material", group_name(graph, instance)},
                           {"rank", instance.rank}};
    for (const Mode mode : {Mode::read, Mode::compute, Mode::update, Mode::accumulate, Mode::reduce}) {
      task[to_string(mode)] = labels_in(graph, instance, mode);
    }
    tasks.push_back(std::move(task));
  }
  nlohmann::json edges = nlohmann::json::array();
  for (const Edge& e : graph.edges()) {
    edges.push_back({{"from", e.from},
                     {"to", e.to},
                     {"label", e.label->name()},
                     {"halo", e.halo},
                     {"bytes", e.bytes},
                     {"message", e.message >= 0}});
  }
  return {{"tasks", tasks}, {"edges", edges}, {"memory", {{"forecast_peak_bytes", forecast_bytes}}}};
}

std::string to_dot(const TaskGraph& graph, int patch)
{
  const auto& instances = graph.instances();
  std::set<int> shown;
  for (int i = 0; i < static_cast<int>(instances.size()); ++i) {
    if (patch < 0 || instances[static_cast<std::size_t>(i)].patch == patch) shown.insert(i);
  }
  if (patch >= 0) {
    const std::set<int> own = shown;
    for (const Edge& e : graph.edges()) {
      if (own.contains(e.from)) shown.insert(e.to);
      if (own.contains(e.to)) shown.insert(e.from);
    }
  }
  std::map<int, std::string> clusters;
  for (const int i : shown) {
    clusters[instances[static_cast<std::size_t>(i)].patch] += dot_node(graph, static_cast<std::size_t>(i));
  }
  std::string dot = "digraph step {\n  rankdir=TB;\n  newrank=true;\n  node [fontsize=10];\n  edge [fontsize=8];\n";
  for (const auto& [id, nodes] : clusters) {
    dot += id < 0 ? nodes : fmt::format("  subgraph cluster_{} {{\n    label=\"patch {}\";\n{}  }}\n", id, id, nodes);
  }
  std::map<std::pair<int, int>, std::string> labels;
  for (const Edge& e : graph.edges()) {
    if (!shown.contains(e.from) || !shown.contains(e.to)) continue;
    std::string& text = labels[{e.from, e.to}];
    if (text.find(e.label->name()) == std::string::npos) text += (text.empty() ? "" : "\\n") + e.label->name();
  }
  for (const auto& [ends, text] : labels) {
    dot += fmt::format("  t{} -> t{} [label=\"{}\"];\n", ends.first, ends.second, text);
  }
  return dot + "}\n";
}

}  // namespace tamp::runtime
