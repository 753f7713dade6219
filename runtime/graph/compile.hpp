#pragma once

#include <vector>

#include "runtime/graph/label_streams.hpp"
#include "runtime/graph/step_builder.hpp"

namespace tamp::runtime
{

/// Expands sound declarations into instances on every patch, and infers the edges and messages between them.
CompiledStep compile(const std::vector<TaskDeclaration>& declarations, const LabelStreams& streams,
                     const PatchLayout& layout, int n_groups);

}  // namespace tamp::runtime
