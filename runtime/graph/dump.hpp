#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// Every task instance and every edge: see the interface in README for the keys.
nlohmann::json to_json(const TaskGraph& graph, std::size_t forecast_bytes);

/// The graph for graphviz, a cluster for each patch; of one patch and what it touches when `patch` is not -1.
std::string to_dot(const TaskGraph& graph, int patch = -1);

}  // namespace tamp::runtime
