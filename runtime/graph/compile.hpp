#pragma once

#include <vector>

#include "runtime/graph/label_streams.hpp"
#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// What the declarations of a step come to, not yet in any order. Edges within a rank join instances directly; data
/// for another rank go by a message, whose sender and receiver are instances too.
struct CompiledStep {
  std::vector<Instance> instances;
  std::vector<Edge> edges;
  std::vector<Message> messages;
};

/// Expands sound declarations into instances on every patch, and infers the edges and messages between them.
CompiledStep compile(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams,
                     const PatchLayout& layout, int n_groups);

}  // namespace tamp::runtime
