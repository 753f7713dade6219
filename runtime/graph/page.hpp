#pragma once

#include <string>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// One page that loads nothing: the drawing of the folded graph, what each task and edge is for, a search, and behind
/// each task its instances by patch and group with what they wait for. The page reads them from JSON within it, columns
/// of numbers, when the first task is opened; a further number of a task, such as its time, is a further key of
/// `tasks`.
std::string to_html(const TaskGraph& graph, const std::string& title);

}  // namespace tamp::runtime
