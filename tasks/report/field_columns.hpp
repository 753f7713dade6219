#pragma once

#include <deque>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/field_columns.hpp"
#include "runtime/warehouse/warehouse.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

/// What a run's field file holds of the state: this rank's part, gathered over its patches. The columns point into this
/// object and are valid until it is asked for the next ones.
template <int D>
class FieldColumns
{
 public:
  /// For each material: id, position, velocity, stress, mean stress p and q (compression positive), density, J, and
  /// what its model shows of its state. Collective.
  std::vector<runtime::ParticleBlock> particles(const Method<D>& method, runtime::Warehouse& warehouse,
                                                const runtime::Communicator& communicator);
  /// Density and velocity at the nodes in the last step, all materials together.
  runtime::NodeBlock nodes(const Method<D>& method, runtime::Warehouse& warehouse);

 private:
  std::deque<std::vector<double>> numbers_;
  std::deque<std::vector<std::int64_t>> ids_;
};

}  // namespace tamp::tasks
