#pragma once

#include <deque>
#include <string>
#include <vector>

#include "runtime/ranks/communicator.hpp"
#include "runtime/storage/fields/field_columns.hpp"
#include "runtime/warehouse/warehouse.hpp"
#include "tasks/method.hpp"

namespace tamp::tasks
{

struct FieldName {
  std::string name;
  runtime::ColumnKind kind;
};

/// The fields that a run can write of a material's particles, but for id; and of the nodes, as a FieldChoice has them.
std::vector<FieldName> particle_field_names(const Scene& scene, const SceneMaterial& material);
std::vector<FieldName> node_field_names();

/// Chosen or not.
bool is_always_written(const std::string& field);

/// What a run's field file holds of the state: this rank's part, gathered over its patches. The columns point into this
/// object and are valid until it is asked for the next ones.
template <int D>
class FieldColumns
{
 public:
  /// For each material: id, position, and those of the chosen fields that it has. Collective.
  std::vector<runtime::ParticleBlock> particles(const Method<D>& method, const FieldChoice& choice,
                                                runtime::Warehouse& warehouse,
                                                const runtime::Communicator& communicator);
  /// The chosen fields of the last step at the nodes, all materials together.
  runtime::NodeBlock nodes(const Method<D>& method, const FieldChoice& choice, runtime::Warehouse& warehouse);

 private:
  std::deque<std::vector<double>> numbers_;
  std::deque<std::vector<std::int64_t>> ids_;
};

}  // namespace tamp::tasks
