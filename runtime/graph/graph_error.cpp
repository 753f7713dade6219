#include "runtime/graph/graph_error.hpp"

namespace tamp::runtime
{

namespace
{

std::string listed(const std::vector<GraphProblem>& problems)
{
  std::string text = "the task graph is not sound:";
  for (const GraphProblem& p : problems) {
    text +=
        "\n  " + std::string(to_string(p.kind)) + ": task '" + p.task + "', label '" + p.label + "': " + p.explanation;
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
  }
  return "";
}

GraphError::GraphError(std::vector<GraphProblem> found) : std::runtime_error(listed(found)), problems(std::move(found))
{
}

}  // namespace tamp::runtime
