#include "runtime/graph/graph_error.hpp"

namespace tamp::runtime
{

namespace
{

std::string listed(const std::vector<GraphProblem>& problems)
{
  std::string text = "the task graph is not sound:";
  for (const GraphProblem& p : problems) {
    const std::string place = p.task.empty() ? "" : "task '" + p.task + "', label '" + p.label + "': ";
    text += "\n  " + std::string(to_string(p.kind)) + ": " + place + p.explanation;
  }
  return text;
}

}  // namespace

const char* to_string(GraphProblem::Kind kind)
{
  switch (kind) {
    case GraphProblem::Kind::missing_producer:
      return "missing producer";
    case GraphProblem::Kind::double_compute:
      return "double compute";
    case GraphProblem::Kind::cycle:
      return "cycle";
    case GraphProblem::Kind::halo_too_narrow:
      return "halo too narrow";
    case GraphProblem::Kind::unused_result:
      return "unused result";
    case GraphProblem::Kind::bad_declaration:
      return "bad declaration";
    case GraphProblem::Kind::other_ranks:
      return "layout on other ranks";
  }
  return "";
}

GraphError::GraphError(std::vector<GraphProblem> found) : std::runtime_error(listed(found)), problems(std::move(found))
{
}

void expect_ranks(const PatchLayout& layout, int n_ranks)
{
  if (layout.n_ranks() == n_ranks) return;
  const std::string found = "its patches are dealt to " + std::to_string(layout.n_ranks()) +
                            " ranks, and the communicator has " + std::to_string(n_ranks);
  throw GraphError({{GraphProblem::Kind::other_ranks, "", "", found + "; see PatchLayout::give_to_ranks"}});
}

}  // namespace tamp::runtime
