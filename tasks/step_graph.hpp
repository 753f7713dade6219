#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "runtime/graph/task_graph.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The patches dealt to the ranks by the particles that start on them, given by patch, then material.
runtime::PatchLayout dealt(const Scene& scene, const std::vector<std::size_t>& n_particles, int n_ranks);

std::vector<std::string> material_names(const Scene& scene);

/// The graph of a scene's time step as a run over several ranks compiles it, to be looked at: one process is enough for
/// it, nothing is stored, and its tasks have lost their bodies.
class StepGraph
{
 public:
  StepGraph(const Scene& scene, int n_ranks);
  StepGraph(const StepGraph&) = delete;
  StepGraph& operator=(const StepGraph&) = delete;

  const runtime::TaskGraph& graph() const { return graph_; }

 private:
  runtime::PatchLayout layout_;
  runtime::TaskGraph graph_;
};

}  // namespace tamp::tasks
