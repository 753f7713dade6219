#pragma once

#include <string>
#include <vector>

#include "runtime/execute/executor.hpp"
#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/fields/field_copy.hpp"
#include "runtime/warehouse/warehouse.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

struct FieldName {
  std::string name;
  runtime::ColumnKind kind;
};

/// The fields that a run can write of a material's particles, but for id; and of the nodes, as a FieldChoice has them.
std::vector<FieldName> particle_field_names(const Scene& scene, int material);
std::vector<FieldName> node_field_names();

/// Chosen or not.
bool is_always_written(const std::string& field);

/// A copy of the state now for a run's field file, of this rank's patches: for each material id, position, and those of
/// the chosen fields that it has; and if asked for, the chosen fields of the last step at the nodes, all materials
/// together. The workers of the executor make it. Collective.
template <int D>
runtime::FieldCopy copy_of_fields(const Method<D>& method, const FieldChoice& choice, bool with_nodes,
                                  runtime::Warehouse& warehouse, runtime::Executor& executor,
                                  const runtime::Communicator& communicator);

}  // namespace tamp::tasks
