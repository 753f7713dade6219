#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// A self-contained page: the drawing of the folded graph, what each task and edge is for, a search, and behind each
/// task its instances by patch and group with what they wait for. The page reads them from JSON within it, columns of
/// numbers, when the first task is opened.
///
/// With the `profile.json` of a run, tasks have the time that they took, darker where it was more, and the longest
/// chain of the mean step is drawn. Tasks are known by their names; how many of them are in the graph, see n_measured.
std::string to_html(const TaskGraph& graph, const std::string& title, const nlohmann::json& profile = nullptr);

/// How many tasks of a graph a profile has.
std::size_t n_measured(const TaskGraph& graph, const nlohmann::json& profile);

}  // namespace tamp::runtime
