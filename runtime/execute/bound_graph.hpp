#pragma once

#include <memory>
#include <vector>

#include "runtime/data/warehouse.hpp"
#include "runtime/execute/migration.hpp"
#include "runtime/graph/task_graph.hpp"

namespace tamp::runtime
{

/// A graph tied to its data: every argument of every instance is resolved once, so that running an instance looks
/// nothing up.
class BoundGraph
{
 public:
  BoundGraph(const TaskGraph& graph, Warehouse& warehouse);

  const TaskGraph& graph() const { return graph_; }
  /// Null when the graph moves no particles.
  Migration* migration() { return migration_.get(); }

  /// Does the work of one instance. Exceptions of task bodies pass through.
  void run(int instance, const Step& step);

  /// Bytes of the fields that an instance declares, as large as they are now.
  std::size_t bytes(int instance) const;
  /// Particles of the instance's patch and group that it declares to use; 0 for others.
  std::size_t n_particles(int instance) const;

 private:
  struct Bound {
    std::vector<Field*> fields;
    std::vector<BoundArgument> arguments;
    bool uses_particles = false;
  };

  Bound bind(const Instance& instance);
  void prepare(const Instance& instance, const Bound& bound);
  void combine(const Label& label);

  const TaskGraph& graph_;
  Warehouse& warehouse_;
  std::unique_ptr<Migration> migration_;
  std::vector<Bound> bound_;
};

}  // namespace tamp::runtime
