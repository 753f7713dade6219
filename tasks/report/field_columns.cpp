#include "tasks/report/field_columns.hpp"

#include "components/materials/state_columns.hpp"
#include "components/portable_math.hpp"
#include "runtime/storage/particle_share.hpp"
#include "tasks/labels.hpp"

namespace tamp::tasks
{

using runtime::Column;
using runtime::ColumnKind;

namespace
{

/// Appends `value(p)` of every particle of a material to one column.
template <int D, class Value>
std::vector<double> gathered(runtime::Warehouse& warehouse, int group, const Value& value)
{
  std::vector<double> all;
  for (const runtime::Patch& patch : warehouse.layout()) {
    const std::size_t n = warehouse.n_particles(patch.id, group);
    for (std::size_t p = 0; p < n; ++p) value(patch.id, p, all);
  }
  return all;
}

template <class T>
void append(std::vector<double>& all, const T& values)
{
  all.insert(all.end(), values.data(), values.data() + values.size());
}

}  // namespace

template <int D>
std::vector<runtime::ParticleBlock> FieldColumns<D>::particles(const Method<D>& method, runtime::Warehouse& warehouse,
                                                               const runtime::Communicator& communicator)
{
  numbers_.clear();
  ids_.clear();
  std::vector<runtime::ParticleBlock> blocks;
  for (int g = 0; g < warehouse.n_groups(); ++g) {
    const SceneMaterial& material = method.materials[static_cast<std::size_t>(g)];
    runtime::ParticleBlock block{
        material.name, warehouse.n_particles(g), {}, runtime::particle_share(warehouse, g, communicator)};
    const auto state = [&](const auto& label, int patch, std::size_t p) { return warehouse.state(label, patch, g)[p]; };
    const auto add = [&](const std::string& name, ColumnKind kind, const auto& value) {
      const auto& numbers = numbers_.emplace_back(gathered<D>(warehouse, g, value));
      block.columns.push_back({name, kind, std::span<const double>(numbers)});
    };
    auto& ids = ids_.emplace_back();
    for (const runtime::Patch& patch : warehouse.layout()) {
      const auto own = warehouse.state(particle::id, patch.id, g);
      ids.insert(ids.end(), own.begin(), own.end());
    }
    block.columns.push_back({"id", ColumnKind::scalar, std::span<const std::int64_t>(ids)});
    add("position", ColumnKind::vector,
        [&](int patch, std::size_t p, auto& all) { append(all, state(particle::position<D>, patch, p)); });
    add("velocity", ColumnKind::vector,
        [&](int patch, std::size_t p, auto& all) { append(all, state(particle::velocity<D>, patch, p)); });
    add("stress", ColumnKind::tensor,
        [&](int patch, std::size_t p, auto& all) { append(all, state(particle::stress<D>, patch, p)); });
    add("p", ColumnKind::scalar, [&](int patch, std::size_t p, auto& all) {
      all.push_back(components::invariants(state(particle::stress<D>, patch, p)).pressure);
    });
    add("q", ColumnKind::scalar, [&](int patch, std::size_t p, auto& all) {
      all.push_back(components::invariants(state(particle::stress<D>, patch, p)).q());
    });
    add("density", ColumnKind::scalar, [&](int patch, std::size_t p, auto& all) {
      all.push_back(state(particle::mass, patch, p) / state(particle::volume, patch, p));
    });
    add("J", ColumnKind::scalar, [&](int patch, std::size_t p, auto& all) {
      all.push_back(state(particle::deformation_gradient<D>, patch, p).determinant());
    });
    std::visit(
        [&]<class Model>(const Model& model) {
          if constexpr (components::has_state<Model>) {
            for (const components::StateColumn<Model>& column : components::state_columns<Model>()) {
              if (column.shown == components::Shown::by_drive) continue;
              add(std::string(column.name), ColumnKind::scalar, [&](int patch, std::size_t p, auto& all) {
                all.push_back(column.value(model, state(particle::state<Model>, patch, p),
                                           components::invariants(state(particle::stress<D>, patch, p))));
              });
            }
          }
        },
        material.model);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

template <int D>
runtime::NodeBlock FieldColumns<D>::nodes(const Method<D>& method, runtime::Warehouse& warehouse)
{
  const runtime::PatchLayout& layout = warehouse.layout();
  const runtime::Grid& grid = layout.grid();
  runtime::NodeBlock block;
  block.origin = grid.lower;
  block.spacing = grid.cell_size;
  runtime::IndexBox all = grid.cells();
  for (std::size_t k = 0; k < D; ++k) ++all.upper[k];
  for (std::size_t k = 0; k < 3; ++k) block.n_nodes[k] = all.upper[k];
  block.boxes.emplace();
  auto& density = numbers_.emplace_back();
  auto& velocity = numbers_.emplace_back();
  const double cell_volume = portable::pow(method.cell_size, D);
  for (const runtime::Patch& patch : layout) {
    if (!warehouse.is_local(patch)) continue;
    block.boxes->push_back(layout.owned_nodes(patch));
    for_each(block.boxes->back(), [&](const runtime::Index& i) {
      Vector<D> momentum = Vector<D>::Zero();
      double mass = 0;
      for (int g = 0; g < warehouse.n_groups(); ++g) {
        const double own = warehouse.grid_result(node::sums<D>, patch.id, g)[i].mass();
        mass += own;
        momentum += own * warehouse.grid_result(node::motion<D>, patch.id, g)[i].velocity();
      }
      density.push_back(mass / cell_volume);
      append(velocity, mass > method.least_node_mass ? Vector<D>(momentum / mass) : Vector<D>(Vector<D>::Zero()));
    });
  }
  block.columns.push_back({"density", ColumnKind::scalar, std::span<const double>(density)});
  block.columns.push_back({"velocity", ColumnKind::vector, std::span<const double>(velocity)});
  return block;
}

template class FieldColumns<2>;
template class FieldColumns<3>;

}  // namespace tamp::tasks
