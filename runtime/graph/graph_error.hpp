#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace tamp::runtime
{

/// One mistake in a set of task declarations.
struct GraphProblem {
  enum class Kind { missing_producer, double_compute, cycle, halo_too_narrow, unused_result, bad_declaration };

  Kind kind;
  std::string task;
  std::string label;
  /// The error and, where it can be guessed, what was meant.
  std::string explanation;
};

const char* to_string(GraphProblem::Kind kind);

/// All mistakes of a graph at once; `what()` has a line for each.
struct GraphError : std::runtime_error {
  explicit GraphError(std::vector<GraphProblem> found);
  std::vector<GraphProblem> problems;
};

}  // namespace tamp::runtime
