#pragma once

#include <string>

#include "runtime/graph/fold.hpp"

namespace tamp::runtime
{

/// Text as it stands in XML and HTML, between tags or in an attribute.
std::string in_markup(const std::string& text);

/// The folded graph as a drawing that needs nothing beside it, the same for the same graph: what is declared in boxes,
/// the runtime's own work in rounded ones, what goes from rank to rank in dashes. Tasks are `g.task` with their number
/// as `data-task`, edges `g.edge` with `data-edge`; their titles say what a box and a line have no room for.
std::string to_svg(const TaskGraph& graph, const FoldedGraph& folded);

}  // namespace tamp::runtime
