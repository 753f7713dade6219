#include "tasks/report/sample_state.hpp"

#include <algorithm>
#include <set>

#include "tasks/labels.hpp"
#include "tasks/report/flaws.hpp"
#include "tasks/report/sample_walls.hpp"

namespace tamp::tasks
{

using components::CellMean;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

/// How far pressures of particles are from the mean of their cell, and what load they are. What is less than a
/// millionth of the pressure that would stop the motion is round-off.
template <int D, class Data>
void sample_pressures(const TaskContext& at, const Data& data)
{
  const auto position = data[particle::position<D>.previous()];
  const auto volume = data[particle::volume.previous()];
  const auto stress = data[particle::stress<D>.previous()];
  const auto mass = data[particle::mass.previous()];
  const auto velocity = data[particle::velocity<D>.previous()];
  const GridView<CellMean> cells = data[cell::pressure];
  average_pressures<D>(at.layout.grid(), position, volume, stress, cells);
  Share& uneven = data[state_sample].uneven_pressure;
  Load& load = data[state_sample].load;
  for (std::size_t p = 0; p < volume.size(); ++p) {
    const double pressure = pressure_of<D>(stress[p]), borne = volume[p] * std::max(pressure, 0.0);
    load.borne += borne;
    load.squared += borne * pressure;
    const double apart = pressure - cells[cell_of<D>(at, position[p])].mean();
    uneven.part += volume[p] * apart * apart;
    const double round_off = 1e-6 * mass[p] / volume[p] * velocity[p].squaredNorm();
    uneven.whole += volume[p] * (pressure * pressure + round_off * round_off);
  }
}

template <int D, class Data>
void sample_torn(const TaskContext& at, const Tearing& is_torn, const Data& data)
{
  const auto id = data[particle::id.previous()];
  const auto position = data[particle::position<D>.previous()];
  const auto stress = data[particle::stress<D>.previous()];
  const auto gradient = data[particle::deformation_gradient<D>.previous()];
  StateSample& sample = data[state_sample];
  sample.torn_apart.whole += static_cast<double>(id.size());
  for (std::size_t p = 0; p < id.size(); ++p) {
    if (!is_torn.template operator()<D>(gradient[p], stress[p])) continue;
    ++sample.torn_apart.part;
    sample.torn = std::min(sample.torn, place_of<D>(id[p], at.group, position[p]));
  }
}

/// How much of the pressure is borne by sand that is looser than any test, and which sand is beyond the largest strain.
template <int D, class Model, class Data>
void sample_range(const TaskContext& at, const Model& model, const Data& data)
{
  const auto id = data[particle::id.previous()];
  const auto position = data[particle::position<D>.previous()];
  const auto stress = data[particle::stress<D>.previous()];
  const auto volume = data[particle::volume.previous()];
  const auto state = data[particle::state<Model>.previous()];
  StateSample& sample = data[state_sample];
  for (std::size_t p = 0; p < id.size(); ++p) {
    const double pressure = pressure_of<D>(stress[p]), borne = volume[p] * std::max(pressure, 0.0);
    const components::Tested tested = model.tested(state[p], pressure);
    sample.borne_by_looser.whole += borne;
    if (tested == components::Tested::within) continue;
    const bool is_looser = tested == components::Tested::looser;
    if (is_looser) sample.borne_by_looser.part += borne;
    ParticlePlace& first = is_looser ? sample.looser : sample.out_of_range;
    first = std::min(first, place_of<D>(id[p], at.group, position[p]));
  }
}

template <int D, class Model>
runtime::TaskDeclaration sample(const Method<D>& method, int material, const Model& model)
{
  auto task = runtime::task("sample state: " + method.materials[static_cast<std::size_t>(material)].name)
                  .over_patches_and_groups({material})
                  .sparse()
                  .reads(particle::id.previous(), particle::position<D>.previous(), particle::volume.previous(),
                         particle::mass.previous(), particle::velocity<D>.previous(), particle::stress<D>.previous(),
                         particle::deformation_gradient<D>.previous())
                  .computes(cell::pressure)
                  .reduces(state_sample);
  if constexpr (HasRange<Model>) {
    return std::move(task).reads(particle::state<Model>.previous()).body([&model](const TaskContext& at, auto data) {
      sample_pressures<D>(at, data);
      sample_range<D>(at, model, data);
    });
  } else {
    const bool tears = may_tear(method.scene, material);
    return std::move(task).body([tears, is_torn = Tearing(method.scene, material)](const TaskContext& at, auto data) {
      sample_pressures<D>(at, data);
      if (tears) sample_torn<D>(at, is_torn, data);
    });
  }
}

/// How much of the matter has swollen, and bears load all the same.
template <int D>
runtime::TaskDeclaration sample_swollen(const Method<D>& method, int material)
{
  const SceneMaterial& of_group = method.materials[static_cast<std::size_t>(material)];
  return runtime::task("sample swollen: " + of_group.name)
      .over_patches_and_groups({material})
      .sparse()
      .reads(particle::id.previous(), particle::position<D>.previous(), particle::volume.previous(),
             particle::mass.previous(), particle::stress<D>.previous(), state_sample, monitor_records.previous())
      .reduces(swollen_sample)
      .body([density = of_group.density](const TaskContext& at, auto data) {
        const auto id = data[particle::id.previous()];
        const auto position = data[particle::position<D>.previous()];
        const auto volume = data[particle::volume.previous()];
        const auto mass = data[particle::mass.previous()];
        const auto stress = data[particle::stress<D>.previous()];
        const double greatest_load =
            std::max(data[state_sample].load.pressure(), data[monitor_records.previous()].greatest_load);
        SwollenSample& sample = data[swollen_sample];
        for (std::size_t p = 0; p < id.size(); ++p) {
          sample.bearing.whole += mass[p];
          const bool is_swollen = volume[p] * density > swollen_from * mass[p];
          if (!is_swollen || pressure_of<D>(stress[p]) <= bears_from * greatest_load) continue;
          sample.bearing.part += mass[p];
          sample.first = std::min(sample.first, place_of<D>(id[p], at.group, position[p]));
        }
      });
}

}  // namespace

template <int D>
runtime::TaskList sample_tasks(const Method<D>& method)
{
  runtime::TaskList tasks;
  for (const int material : method.deformable_materials) {
    std::visit([&](const auto& model) { tasks.push_back(sample(method, material, model)); },
               method.materials[static_cast<std::size_t>(material)].model);
  }
  for (const int material : method.deformable_materials) tasks.push_back(sample_swollen(method, material));
  const runtime::TaskList at_walls = wall_sample_tasks(method);
  tasks.insert(tasks.end(), at_walls.begin(), at_walls.end());
  return tasks;
}

template <int D>
runtime::HostData sample_data(const Method<D>& method)
{
  runtime::HostData data{
      {&particle::id, &particle::position<D>, &particle::volume, &particle::mass, &particle::velocity<D>,
       &particle::stress<D>, &particle::deformation_gradient<D>, &monitor_records},
      {&state_sample, &swollen_sample, &cell::pressure}};
  if (!wall_sample_tasks(method).empty()) data.results.insert(data.results.end(), {&wall_sample, &node::wall_gaps<D>});
  std::set<const runtime::Label*> states;
  for (const int material : method.deformable_materials) {
    std::visit(
        [&]<class Model>(const Model&) {
          if constexpr (HasRange<Model>) states.insert(&particle::state<Model>);
        },
        method.materials[static_cast<std::size_t>(material)].model);
  }
  data.state.insert(data.state.end(), states.begin(), states.end());
  return data;
}

template runtime::HostData sample_data(const Method<2>&);
template runtime::HostData sample_data(const Method<3>&);
template runtime::TaskList sample_tasks(const Method<2>&);
template runtime::TaskList sample_tasks(const Method<3>&);

}  // namespace tamp::tasks
