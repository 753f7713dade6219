#include "tasks/report/field_columns.hpp"

#include <array>
#include <functional>
#include <tuple>

#include "components/materials/state_columns.hpp"
#include "components/portable_math.hpp"
#include "runtime/execute/on_workers.hpp"
#include "runtime/storage/row_share.hpp"
#include "tasks/labels.hpp"
#include "tasks/report/flaws.hpp"

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

/// A field of particles: its name, and what appends the numbers of all of a patch and group.
struct ParticleField {
  using Add = std::function<void(runtime::Warehouse&, int patch, int group, std::vector<double>&)>;

  ParticleField(std::string field_name, Add add_all)
      : name(std::move(field_name)), kind(ColumnKind::scalar), add(std::move(add_all))
  {
  }
  /// `value` makes the numbers of a particle of what it has under the labels.
  template <class Value, class... Labels>
  ParticleField(std::string field_name, ColumnKind field_kind, const Value& value, const Labels&... labels)
      : name(std::move(field_name)),
        kind(field_kind),
        add([value, &labels...](runtime::Warehouse& warehouse, int patch, int group, std::vector<double>& all) {
          const std::tuple particles(warehouse.state(labels, patch, group)...);
          for (std::size_t p = 0; p < warehouse.n_particles(patch, group); ++p) {
            std::apply([&](const auto&... of_label) { append(all, value(of_label[p]...)); }, particles);
          }
        })
  {
  }

  std::string name;
  ColumnKind kind;
  Add add;
};

template <int D, class Model>
void add_state_fields(const Model& model, std::vector<ParticleField>& fields)
{
  if constexpr (components::has_state<Model>) {
    for (const components::StateColumn<Model>& column : components::state_columns<Model>()) {
      if (column.shown == components::Shown::by_drive) continue;
      if (column.is_written != nullptr && !column.is_written(model)) continue;
      fields.emplace_back(
          std::string(column.name), ColumnKind::scalar,
          [&model, &column](const typename Model::State& state, const SymmetricTensor<D>& stress) {
            return column.value(model, state, components::invariants(stress));
          },
          particle::state<Model>, particle::stress<D>);
    }
  }
  if (components::keeps_gaps(model)) {
    fields.emplace_back(
        "opening", ColumnKind::scalar, [](double gap) { return gap; }, particle::opening);
  }
}

/// The pressure of particles less the mean in their cells.
template <int D>
void add_uneven_pressures(runtime::Warehouse& warehouse, int patch, int group, std::vector<double>& all)
{
  const auto position = warehouse.state(particle::position<D>, patch, group);
  const auto stress = warehouse.state(particle::stress<D>, patch, group);
  const runtime::PatchLayout& layout = warehouse.layout();
  const runtime::IndexBox& box = layout[patch].cells;
  std::vector<components::CellMean> means(static_cast<std::size_t>(box.size()));
  const runtime::GridView<components::CellMean> cells(
      means.data(), box, {1, box.extent(0), std::ptrdiff_t{box.extent(0)} * box.extent(1)});
  average_pressures<D>(layout.grid(), position, warehouse.state(particle::volume, patch, group), stress, cells);
  for (std::size_t p = 0; p < position.size(); ++p) {
    const double mean = cells[cell_of<D>(layout.grid(), box, position[p])].mean();
    all.push_back(pressure_of<D>(stress[p]) - mean);
  }
}

/// Adds the flaws of single particles that the monitors of the same names sum up.
template <int D>
void add_flaws(const Scene& scene, int material, std::vector<ParticleField>& fields)
{
  using Stress = SymmetricTensor<D>;
  fields.emplace_back("uneven_pressure", add_uneven_pressures<D>);
  if (may_tear(scene, material)) {
    fields.emplace_back(
        "torn_apart", ColumnKind::scalar,
        [is_torn = Tearing(scene, material)](const Matrix<D>& gradient, const Stress& stress) {
          return is_torn.template operator()<D>(gradient, stress) ? 1.0 : 0.0;
        },
        particle::deformation_gradient<D>, particle::stress<D>);
  }
  std::visit(
      [&]<class Model>(const Model& model) {
        if constexpr (HasRange<Model>) {
          const auto add = [&](const char* name, components::Tested where) {
            fields.emplace_back(
                name, ColumnKind::scalar,
                [&model, where](const typename Model::State& state, const Stress& stress) {
                  return model.tested(state, pressure_of<D>(stress)) == where ? 1.0 : 0.0;
                },
                particle::state<Model>, particle::stress<D>);
          };
          add("looser_than_tested", components::Tested::looser);
          add("out_of_range", components::Tested::beyond);
        }
      },
      scene.materials[static_cast<std::size_t>(material)].model);
}

/// The volume over that of the undeformed particle. Rigid bodies keep theirs.
template <int D>
ParticleField volume_ratio_field(const Scene& scene, int material)
{
  const auto in_plane = [](const Matrix<D>& f) { return f.determinant(); };
  const auto of_ring = [](const Matrix<D>& f, double hoop_stretch) { return f.determinant() * hoop_stretch; };
  if (!scene.axisymmetric || scene.is_rigid(material)) {
    return {"J", ColumnKind::scalar, in_plane, particle::deformation_gradient<D>};
  }
  return {"J", ColumnKind::scalar, of_ring, particle::deformation_gradient<D>, particle::hoop_stretch};
}

/// All fields that can be written for a material's particles, but for id; the scene must outlive them.
template <int D>
std::vector<ParticleField> particle_fields(const Scene& scene, int material)
{
  using Stress = SymmetricTensor<D>;
  const auto as_it_is = [](const auto& value) { return value; };
  std::vector<ParticleField> fields{
      {position_field, ColumnKind::vector, as_it_is, particle::position<D>},
      {"velocity", ColumnKind::vector, as_it_is, particle::velocity<D>},
      {"stress", ColumnKind::tensor, as_it_is, particle::stress<D>},
      {"p", ColumnKind::scalar, [](const Stress& s) { return components::invariants(s).pressure; },
       particle::stress<D>},
      {"q", ColumnKind::scalar, [](const Stress& s) { return components::invariants(s).q(); }, particle::stress<D>},
      {"density", ColumnKind::scalar, [](double mass, double volume) { return mass / volume; }, particle::mass,
       particle::volume},
      volume_ratio_field<D>(scene, material)};
  if (scene.is_periodic()) {
    // How often it has gone around the domain along each axis.
    const auto along_axes = [](const runtime::Index& laps) -> Vector<D> {
      return Eigen::Map<const Eigen::Matrix<int, D, 1>>(laps.data()).template cast<double>();
    };
    fields.emplace_back("laps", ColumnKind::vector, along_axes, particle::laps);
  }
  std::visit([&](const auto& model) { add_state_fields<D>(model, fields); },
             scene.materials[static_cast<std::size_t>(material)].model);
  if (!scene.is_rigid(material)) add_flaws<D>(scene, material, fields);
  return fields;
}

/// The matter at a node, all materials together.
template <int D>
struct NodeMatter {
  double mass = 0;
  Vector<D> momentum = Vector<D>::Zero();
};

/// All materials together at the nodes of a patch.
template <int D>
class MatterOfPatch
{
 public:
  MatterOfPatch(runtime::Warehouse& warehouse, int patch)
  {
    for (int g = 0; g < warehouse.n_groups(); ++g) {
      sums_.push_back(warehouse.grid_result(node::sums<D>, patch, g));
      motion_.push_back(warehouse.grid_result(node::motion<D>, patch, g));
    }
  }

  NodeMatter<D> at(const runtime::Index& i) const
  {
    NodeMatter<D> matter;
    for (std::size_t g = 0; g < sums_.size(); ++g) {
      const double own = sums_[g][i].mass();
      matter.mass += own;
      matter.momentum += own * motion_[g][i].velocity();
    }
    return matter;
  }

 private:
  std::vector<runtime::GridView<const components::NodeSums<D>>> sums_;
  std::vector<runtime::GridView<const components::NodeMotion<D>>> motion_;
};

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

/// Lays out the columns of a copy, and then has workers fill them, a column each.
template <int D>
class FieldCopier
{
 public:
  FieldCopier(const Method<D>& method, const FieldChoice& choice, runtime::Warehouse& warehouse)
      : method_(method), choice_(choice), warehouse_(warehouse)
  {
  }

  void add_particles(int group, const runtime::Communicator& communicator)
  {
    const SceneMaterial& material = method_.materials[static_cast<std::size_t>(group)];
    const auto& n_by_patch =
        copy_.n_particles.emplace_back(runtime::particles_by_patch(warehouse_, group, communicator));
    auto& block = copy_.particles.emplace_back(runtime::ParticleBlock{
        material.name, warehouse_.n_particles(group), {}, runtime::particle_share(warehouse_, n_by_patch)});
    add_column<std::int64_t>(block.columns, "id", ColumnKind::scalar, block.n, [=, this](int patch, auto& ids) {
      const auto own = warehouse_.state(particle::id, patch, group);
      ids.insert(ids.end(), own.begin(), own.end());
    });
    for (const ParticleField& field : particle_fields<D>(method_.scene, group)) {
      if (!choice_.has(field.name) && !is_always_written(field.name)) continue;
      add_column<double>(block.columns, field.name, field.kind, block.n,
                         [=, this](int patch, auto& numbers) { field.add(warehouse_, patch, group, numbers); });
    }
  }

  void add_nodes()
  {
    const runtime::PatchLayout& layout = warehouse_.layout();
    const runtime::Grid& grid = layout.grid();
    runtime::NodeBlock& block = copy_.nodes.emplace();
    block.origin = grid.lower;
    block.spacing = grid.cell_size;
    runtime::IndexBox all = grid.cells();
    for (std::size_t k = 0; k < D; ++k) ++all.upper[k];
    for (std::size_t k = 0; k < 3; ++k) block.n_nodes[k] = all.upper[k];
    block.boxes.emplace();
    std::size_t n = 0;
    for (const runtime::Patch& patch : layout) {
      if (!warehouse_.is_local(patch)) continue;
      n += static_cast<std::size_t>(block.boxes->emplace_back(layout.shown_nodes(patch)).size());
    }
    for (const NodeField<D>& field : node_fields<D>()) {
      if (!choice_.has(field.choice())) continue;
      add_column<double>(block.columns, field.name, field.kind, n, [=, this, &layout](int patch, auto& numbers) {
        const MatterOfPatch<D> matter(warehouse_, patch);
        for_each(layout.shown_nodes(layout[patch]),
                 [&](const runtime::Index& i) { field.add(method_, matter.at(i), numbers); });
      });
    }
  }

  runtime::FieldCopy filled(runtime::Executor& executor)
  {
    runtime::on_workers(executor, static_cast<int>(fill_.size()),
                        [this](int i) { fill_[static_cast<std::size_t>(i)](); });
    copy_.show_values();
    return std::move(copy_);
  }

 private:
  /// Adds a column of `n` items; `add` appends the values of a patch.
  template <class T, class Add>
  void add_column(std::vector<Column>& columns, const std::string& name, ColumnKind kind, std::size_t n, const Add& add)
  {
    columns.push_back({name, kind, {}});
    auto& values = copy_.values.emplace_back(std::vector<T>());
    fill_.push_back([this, add, n_values = n * runtime::n_in_file(kind), &all = std::get<std::vector<T>>(values)] {
      all.reserve(n_values);
      for (const runtime::Patch& patch : warehouse_.layout()) {
        if (warehouse_.is_local(patch)) add(patch.id, all);
      }
    });
  }

  const Method<D>& method_;
  const FieldChoice& choice_;
  runtime::Warehouse& warehouse_;
  runtime::FieldCopy copy_;
  std::vector<std::function<void()>> fill_;
};

}  // namespace

// Names and kinds are the same in two and three dimensions.
std::vector<FieldName> particle_field_names(const Scene& scene, int material)
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
runtime::FieldCopy copy_of_fields(const Method<D>& method, const FieldChoice& choice, bool with_nodes,
                                  runtime::Warehouse& warehouse, runtime::Executor& executor,
                                  const runtime::Communicator& communicator)
{
  FieldCopier<D> copier(method, choice, warehouse);
  for (int g = 0; g < warehouse.n_groups(); ++g) copier.add_particles(g, communicator);
  if (with_nodes) copier.add_nodes();
  return copier.filled(executor);
}

template runtime::FieldCopy copy_of_fields(const Method<2>&, const FieldChoice&, bool, runtime::Warehouse&,
                                           runtime::Executor&, const runtime::Communicator&);
template runtime::FieldCopy copy_of_fields(const Method<3>&, const FieldChoice&, bool, runtime::Warehouse&,
                                           runtime::Executor&, const runtime::Communicator&);

}  // namespace tamp::tasks
