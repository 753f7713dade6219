#include "tasks/report/field_columns.hpp"

#include <array>
#include <functional>

#include "components/materials/state_columns.hpp"
#include "components/portable_math.hpp"
#include "runtime/storage/row_share.hpp"
#include "tasks/labels.hpp"

namespace tamp::tasks
{

using runtime::Column;
using runtime::ColumnKind;

namespace
{

const std::string position_field = "position";

void append(std::vector<double>& all, double value)
{
  all.push_back(value);
}

template <class T>
void append(std::vector<double>& all, const T& values)
{
  all.insert(all.end(), values.data(), values.data() + values.size());
}

/// One particle, whose data are asked for by label.
struct ParticleAt {
  runtime::Warehouse& warehouse;
  int patch;
  int group;
  std::size_t p;

  template <class T>
  const T& operator[](const runtime::TypedLabel<T, runtime::Centring::particle>& label) const
  {
    return warehouse.state(label, patch, group)[p];
  }
};

/// A field of particles: its name, and what appends the numbers of one.
struct ParticleField {
  template <class Value>
  ParticleField(std::string field_name, ColumnKind field_kind, const Value& value)
      : name(std::move(field_name)),
        kind(field_kind),
        add([value](const ParticleAt& at, std::vector<double>& all) { append(all, value(at)); })
  {
  }

  std::string name;
  ColumnKind kind;
  std::function<void(const ParticleAt&, std::vector<double>&)> add;
};

template <int D, class Model>
void add_state_fields(const Model& model, std::vector<ParticleField>& fields)
{
  if constexpr (components::has_state<Model>) {
    for (const components::StateColumn<Model>& column : components::state_columns<Model>()) {
      if (column.shown == components::Shown::by_drive) continue;
      fields.emplace_back(std::string(column.name), ColumnKind::scalar, [&model, &column](const ParticleAt& at) {
        return column.value(model, at[particle::state<Model>], components::invariants(at[particle::stress<D>]));
      });
    }
  }
}

/// How often a particle has gone around the domain along each axis.
template <int D>
Vector<D> laps_of(const ParticleAt& at)
{
  const runtime::Index& laps = at[particle::laps];
  return Eigen::Map<const Eigen::Matrix<int, D, 1>>(laps.data()).template cast<double>();
}

/// All that can be written of a material's particles, but for id; the material must outlive it.
template <int D>
std::vector<ParticleField> particle_fields(const Scene& scene, const SceneMaterial& material)
{
  using At = const ParticleAt&;
  const auto invariants = [](At at) { return components::invariants(at[particle::stress<D>]); };
  std::vector<ParticleField> fields{
      {position_field, ColumnKind::vector, [](At at) { return at[particle::position<D>]; }},
      {"velocity", ColumnKind::vector, [](At at) { return at[particle::velocity<D>]; }},
      {"stress", ColumnKind::tensor, [](At at) { return at[particle::stress<D>]; }},
      {"p", ColumnKind::scalar, [invariants](At at) { return invariants(at).pressure; }},
      {"q", ColumnKind::scalar, [invariants](At at) { return invariants(at).q(); }},
      {"density", ColumnKind::scalar, [](At at) { return at[particle::mass] / at[particle::volume]; }},
      {"J", ColumnKind::scalar, [](At at) { return at[particle::deformation_gradient<D>].determinant(); }}};
  if (scene.is_periodic()) fields.emplace_back("laps", ColumnKind::vector, laps_of<D>);
  std::visit([&](const auto& model) { add_state_fields<D>(model, fields); }, material.model);
  return fields;
}

/// The matter at a node, all materials together.
template <int D>
struct NodeMatter {
  double mass = 0;
  Vector<D> momentum = Vector<D>::Zero();
};

template <int D>
NodeMatter<D> matter_at(runtime::Warehouse& warehouse, int patch, const runtime::Index& i)
{
  NodeMatter<D> matter;
  for (int g = 0; g < warehouse.n_groups(); ++g) {
    const double own = warehouse.grid_result(node::sums<D>, patch, g)[i].mass();
    matter.mass += own;
    matter.momentum += own * warehouse.grid_result(node::motion<D>, patch, g)[i].velocity();
  }
  return matter;
}

/// A field of nodes: its name in a FieldChoice and in the file, and what appends the numbers of one.
template <int D>
struct NodeField {
  std::string name;
  ColumnKind kind;
  std::function<void(const Method<D>&, const NodeMatter<D>&, std::vector<double>&)> add;

  std::string choice() const { return "nodes/" + name; }
};

template <int D>
std::vector<NodeField<D>> node_fields()
{
  using Numbers = std::vector<double>;
  return {{"density", ColumnKind::scalar,
           [](const Method<D>& method, const NodeMatter<D>& matter, Numbers& all) {
             all.push_back(matter.mass / portable::pow(method.cell_size, D));
           }},
          {"velocity", ColumnKind::vector, [](const Method<D>& method, const NodeMatter<D>& matter, Numbers& all) {
             const bool moves = matter.mass > method.least_node_mass;
             append(all, moves ? Vector<D>(matter.momentum / matter.mass) : Vector<D>(Vector<D>::Zero()));
           }}};
}

template <int D>
void append_nodes(const Method<D>& method, runtime::Warehouse& warehouse, const NodeField<D>& field,
                  std::vector<double>& all)
{
  for (const runtime::Patch& patch : warehouse.layout()) {
    if (!warehouse.is_local(patch)) continue;
    for_each(warehouse.layout().shown_nodes(patch),
             [&](const runtime::Index& i) { field.add(method, matter_at<D>(warehouse, patch.id, i), all); });
  }
}

}  // namespace

// Names and kinds are the same in two and three dimensions.
std::vector<FieldName> particle_field_names(const Scene& scene, const SceneMaterial& material)
{
  std::vector<FieldName> names;
  for (const ParticleField& field : particle_fields<2>(scene, material)) names.push_back({field.name, field.kind});
  return names;
}

std::vector<FieldName> node_field_names()
{
  std::vector<FieldName> names;
  for (const NodeField<2>& field : node_fields<2>()) names.push_back({field.choice(), field.kind});
  return names;
}

bool is_always_written(const std::string& field)
{
  return field == position_field;
}

template <int D>
std::vector<runtime::ParticleBlock> FieldColumns<D>::particles(const Method<D>& method, const FieldChoice& choice,
                                                               runtime::Warehouse& warehouse,
                                                               const runtime::Communicator& communicator)
{
  numbers_.clear();
  ids_.clear();
  std::vector<runtime::ParticleBlock> blocks;
  for (int g = 0; g < warehouse.n_groups(); ++g) {
    const SceneMaterial& material = method.materials[static_cast<std::size_t>(g)];
    runtime::ParticleBlock block{
        material.name, warehouse.n_particles(g), {}, runtime::particle_share(warehouse, g, communicator)};
    auto& ids = ids_.emplace_back();
    for (const runtime::Patch& patch : warehouse.layout()) {
      const auto own = warehouse.state(particle::id, patch.id, g);
      ids.insert(ids.end(), own.begin(), own.end());
    }
    block.columns.push_back({"id", ColumnKind::scalar, std::span<const std::int64_t>(ids)});
    for (const ParticleField& field : particle_fields<D>(method.scene, material)) {
      if (!choice.has(field.name) && !is_always_written(field.name)) continue;
      auto& numbers = numbers_.emplace_back();
      for (const runtime::Patch& patch : warehouse.layout()) {
        const std::size_t n = warehouse.n_particles(patch.id, g);
        for (std::size_t p = 0; p < n; ++p) field.add({warehouse, patch.id, g, p}, numbers);
      }
      block.columns.push_back({field.name, field.kind, std::span<const double>(numbers)});
    }
    blocks.push_back(std::move(block));
  }
  return blocks;
}

template <int D>
runtime::NodeBlock FieldColumns<D>::nodes(const Method<D>& method, const FieldChoice& choice,
                                          runtime::Warehouse& warehouse)
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
  std::vector<NodeField<D>> fields = node_fields<D>();
  std::erase_if(fields, [&](const NodeField<D>& field) { return !choice.has(field.choice()); });
  for (const runtime::Patch& patch : layout) {
    if (warehouse.is_local(patch)) block.boxes->push_back(layout.shown_nodes(patch));
  }
  for (const NodeField<D>& field : fields) {
    auto& numbers = numbers_.emplace_back();
    append_nodes(method, warehouse, field, numbers);
    block.columns.push_back({field.name, field.kind, std::span<const double>(numbers)});
  }
  return block;
}

template class FieldColumns<2>;
template class FieldColumns<3>;

}  // namespace tamp::tasks
