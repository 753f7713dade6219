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

/// The text as it stands between the quotes of a dot file.
std::string in_quotes(const std::string& text)
{
  std::string safe;
  for (const char c : text) {
    if (c == '"' || c == '\\') safe += '\\';
    safe += c;
  }
  return safe;
}

const char* shape_of(InstanceKind kind)
{
  return kind == InstanceKind::body ? "box" : "ellipse";
}

constexpr const char* dot_begin =
    "digraph step {\n  rankdir=TB;\n  newrank=true;\n  node [fontsize=10];\n  edge [fontsize=8];\n";

std::string dot_node(const TaskGraph& graph, std::size_t i)
{
  const Instance& instance = graph.instances()[i];
  const std::string group =
      instance.group < 0 ? "" : "\\n" + in_quotes(graph.group_names()[static_cast<std::size_t>(instance.group)]);
  return fmt::format("    t{} [label=\"{}{}\", shape={}];\n", i, in_quotes(graph.name(instance)), group,
                     shape_of(instance.kind));
}

std::string dot_label(const FoldedLabel& label)
{
  const std::string name = in_quotes(label.label->name());
  return label.halo > 0 ? fmt::format("{}, halo {}", name, label.halo) : name;
}

nlohmann::json labels_of(const FoldedEdge& edge)
{
  nlohmann::json labels = nlohmann::json::array();
  for (const FoldedLabel& l : edge.labels) {
    labels.push_back({{"label", l.label->name()},
                      {"halo", l.halo},
                      {"bytes", l.bytes},
                      {"edges", l.n_edges},
                      {"crossing", l.n_crossing}});
  }
  return labels;
}

}  // namespace

const char* to_string(InstanceKind kind)
{
  switch (kind) {
    case InstanceKind::body:
      return "task";
    case InstanceKind::sum_halo:
      return "halo sum";
    case InstanceKind::fill_halo:
      return "halo fill";
    case InstanceKind::combine:
      return "combining";
    case InstanceKind::send_particles:
      return "particles sent";
    case InstanceKind::receive_particles:
      return "particles received";
    case InstanceKind::send_message:
      return "message sent";
    case InstanceKind::receive_message:
      return "message received";
  }
  return "";
}

nlohmann::json uses_of(const TaskGraph& graph, const Instance& instance)
{
  nlohmann::json uses = nlohmann::json::object();
  for (const Mode mode : {Mode::read, Mode::compute, Mode::update, Mode::accumulate, Mode::reduce}) {
    uses[to_string(mode)] = labels_in(graph, instance, mode);
  }
  return uses;
}

nlohmann::json to_json(const TaskGraph& graph, const FoldedGraph& folded)
{
  nlohmann::json tasks = nlohmann::json::array();
  for (const FoldedTask& task : folded.tasks) {
    nlohmann::json materials = nlohmann::json::array();
    for (const int group : task.groups) materials.push_back(graph.group_names()[static_cast<std::size_t>(group)]);
    const Instance& first = graph.instances()[static_cast<std::size_t>(task.instances.front())];
    nlohmann::json folded_task = uses_of(graph, first);
    folded_task.update({{"id", tasks.size()},
                        {"name", task.name},
                        {"kind", to_string(task.kind)},
                        {"instances", task.instances.size()},
                        {"materials", materials}});
    tasks.push_back(std::move(folded_task));
  }
  nlohmann::json edges = nlohmann::json::array();
  for (const FoldedEdge& e : folded.edges) edges.push_back({{"from", e.from}, {"to", e.to}, {"labels", labels_of(e)}});
  return {{"tasks", tasks}, {"edges", edges}};
}

nlohmann::json to_json(const TaskGraph& graph, std::size_t forecast_bytes)
{
  nlohmann::json tasks = nlohmann::json::array();
  for (const Instance& instance : graph.instances()) {
    nlohmann::json task = uses_of(graph, instance);
    task.update({{"id", tasks.size()},
                 {"name", graph.name(instance)},
                 {"patch", instance.patch},
                 {"material", group_name(graph, instance)},
                 {"rank", instance.rank}});
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
  return {{"tasks", tasks},
          {"edges", edges},
          {"folded", to_json(graph, fold(graph))},
          {"memory", {{"forecast_peak_bytes", forecast_bytes}}}};
}

std::string to_dot(const TaskGraph& graph, const FoldedGraph& folded)
{
  std::string dot = dot_begin;
  for (std::size_t i = 0; i < folded.tasks.size(); ++i) {
    const FoldedTask& task = folded.tasks[i];
    std::string groups;
    for (const int group : task.groups) {
      groups += (groups.empty() ? " for " : ", ") + in_quotes(graph.group_names()[static_cast<std::size_t>(group)]);
    }
    dot += fmt::format("  t{} [label=\"{}\\n{} times{}\", shape={}];\n", i, in_quotes(task.name), task.instances.size(),
                       groups, shape_of(task.kind));
  }
  for (const FoldedEdge& e : folded.edges) {
    std::string labels;
    for (const FoldedLabel& label : e.labels) labels += (labels.empty() ? "" : "\\n") + dot_label(label);
    dot += fmt::format("  t{} -> t{} [label=\"{}\"{}];\n", e.from, e.to, labels, e.crosses() ? ", style=dashed" : "");
  }
  return dot + "}\n";
}

std::string to_dot(const TaskGraph& graph, int patch)
{
  const auto& instances = graph.instances();
  std::set<int> shown;
  for (int i = 0; i < static_cast<int>(instances.size()); ++i) {
    if (instances[static_cast<std::size_t>(i)].patch == patch) shown.insert(i);
  }
  const std::set<int> own = shown;
  for (const Edge& e : graph.edges()) {
    if (own.contains(e.from)) shown.insert(e.to);
    if (own.contains(e.to)) shown.insert(e.from);
  }
  std::map<int, std::string> clusters;
  for (const int i : shown) {
    clusters[instances[static_cast<std::size_t>(i)].patch] += dot_node(graph, static_cast<std::size_t>(i));
  }
  std::string dot = dot_begin;
  for (const auto& [id, nodes] : clusters) {
    dot += id < 0 ? nodes : fmt::format("  subgraph cluster_{} {{\n    label=\"patch {}\";\n{}  }}\n", id, id, nodes);
  }
  std::map<std::pair<int, int>, std::set<std::string>> labels;
  std::set<std::pair<int, int>> messages;
  for (const Edge& e : graph.edges()) {
    if (!shown.contains(e.from) || !shown.contains(e.to)) continue;
    labels[{e.from, e.to}].insert(in_quotes(e.label->name()));
    if (e.message >= 0) messages.insert({e.from, e.to});
  }
  for (const auto& [ends, names] : labels) {
    dot += fmt::format("  t{} -> t{} [label=\"{}\"{}];\n", ends.first, ends.second, fmt::join(names, "\\n"),
                       messages.contains(ends) ? ", style=dashed" : "");
  }
  return dot + "}\n";
}

}  // namespace tamp::runtime
