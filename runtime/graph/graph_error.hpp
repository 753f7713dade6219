#pragma once

#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/grid/patch_layout.hpp"

namespace tamp::runtime
{

/// One mistake in a set of task declarations, or of the layout that they are to run on.
struct GraphProblem {
  enum class Kind {
    missing_producer,
    double_compute,
    cycle,
    halo_too_narrow,
    unused_result,
    bad_declaration,
    other_ranks
  };

  Kind kind;
  /// Both empty where it is the layout's.
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

/// Throws GraphError for a layout that is not dealt to so many ranks, whose data and messages would be other ranks'.
void expect_ranks(const PatchLayout& layout, int n_ranks);

}  // namespace tamp::runtime
