#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// All instances of one name.
struct FoldedTask {
  std::string name;
  InstanceKind kind = InstanceKind::body;
  /// Numbers of the instances in the graph, ascending.
  std::vector<int> instances;
  /// Ascending; empty where each instance is for all groups.
  std::vector<int> groups;
};

/// All edges between the instances of two tasks for one label.
struct FoldedLabel {
  const Label* label = nullptr;
  /// The widest halo of all the edges.
  int halo = 0;
  /// Bytes that pass along all the edges together.
  std::size_t bytes = 0;
  std::size_t n_edges = 0;
  /// Number of edges that lead from one rank to another.
  std::size_t n_crossing = 0;
};

/// Why instances of one task wait for instances of another.
struct FoldedEdge {
  int from = 0;
  int to = 0;
  /// Labels in the order of their names.
  std::vector<FoldedLabel> labels;

  bool crosses() const;
};

/// A graph in which the number of patches no longer shows: tasks in the order in which their first instances stand.
struct FoldedGraph {
  std::vector<FoldedTask> tasks;
  /// Edges in the order of `from`, then `to`.
  std::vector<FoldedEdge> edges;
  /// The task of each instance.
  std::vector<int> task_of;
};

FoldedGraph fold(const TaskGraph& graph);

}  // namespace tamp::runtime
