#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/graph/fold.hpp"
#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// The labels that an instance reads, computes, updates, accumulates and reduces: a list for each of these words.
nlohmann::json uses_of(const TaskGraph& graph, const Instance& instance);

/// The tasks and edges of a folded graph; see docs/how_to/ranks.md for the keys.
nlohmann::json to_json(const TaskGraph& graph, const FoldedGraph& folded);

/// Every task instance and every edge, and under `folded` the same by task.
nlohmann::json to_json(const TaskGraph& graph, std::size_t forecast_bytes);

/// The folded graph for graphviz.
std::string to_dot(const TaskGraph& graph, const FoldedGraph& folded);

/// The instances of one patch and what they touch, for graphviz, a cluster for each patch.
std::string to_dot(const TaskGraph& graph, int patch);

/// The kind in words: "task", "halo sum", "message sent" and so on.
const char* to_string(InstanceKind kind);

}  // namespace tamp::runtime
