#include "tasks/report/sample_state.hpp"

#include <algorithm>

#include "tasks/cells.hpp"
#include "tasks/labels.hpp"

namespace tamp::tasks
{

using components::CellMean;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

template <int D>
double pressure_of(const SymmetricTensor<D>& stress)
{
  return -trace(stress) / 3;
}

/// Mean pressures of the cells, and how far those of the particles are from them. What is less than a millionth of the
/// pressure that would stop the motion is round-off.
template <int D, class Data>
void sample_pressures(const TaskContext& at, const Data& data)
{
  const auto position = data[particle::position<D>.previous()];
  const auto volume = data[particle::volume.previous()];
  const auto stress = data[particle::stress<D>.previous()];
  const auto mass = data[particle::mass.previous()];
  const auto velocity = data[particle::velocity<D>.previous()];
  const GridView<CellMean> cells = data[cell::pressure];
  Share& uneven = data[state_sample].uneven_pressure;
  for_each(cells.box(), [&](const Index& i) { cells[i] = {}; });
  for (std::size_t p = 0; p < volume.size(); ++p) {
    cells[cell_of<D>(at, position[p])].add(volume[p], pressure_of<D>(stress[p]));
  }
  for (std::size_t p = 0; p < volume.size(); ++p) {
    const double pressure = pressure_of<D>(stress[p]);
    const double apart = pressure - cells[cell_of<D>(at, position[p])].mean();
    uneven.part += volume[p] * apart * apart;
    const double round_off = 1e-6 * mass[p] / volume[p] * velocity[p].squaredNorm();
    uneven.whole += volume[p] * (pressure * pressure + round_off * round_off);
  }
}

/// Neighbours along an axis of the undeformed body that are so many cells apart meet at no node [cells].
constexpr double torn_at = 1.2;

/// Particles that are torn from their neighbours, and which stress pulls all the same.
template <int D, class Data>
void sample_torn(const TaskContext& at, double spacing, const Data& data)
{
  const auto id = data[particle::id.previous()];
  const auto position = data[particle::position<D>.previous()];
  const auto stress = data[particle::stress<D>.previous()];
  const auto gradient = data[particle::deformation_gradient<D>.previous()];
  const double furthest = torn_at * at.layout.grid().cell_size;
  StateSample& sample = data[state_sample];
  sample.torn_apart.whole += static_cast<double>(id.size());
  for (std::size_t p = 0; p < id.size(); ++p) {
    const double stretch = gradient[p].colwise().norm().maxCoeff();
    if (stretch * spacing <= furthest || pressure_of<D>(stress[p]) >= 0) continue;
    ++sample.torn_apart.part;
    sample.torn = std::min(sample.torn, place_of<D>(id[p], at.group, position[p]));
  }
}

/// In matter that flows, neighbours change; and domains that stretch with their particles stay together.
template <int D>
bool may_tear(const Method<D>& method, int material)
{
  const bool stretches = method.scene.interpolator == "cpdi" || method.scene.interpolator == "cpgimp";
  const MaterialModel& model = method.materials[static_cast<std::size_t>(material)].model;
  return !stretches && std::visit([]<class Model>(const Model&) { return !components::has_state<Model>; }, model);
}

template <int D>
runtime::TaskDeclaration sample(const Method<D>& method, int material)
{
  const double spacing = method.scene.grid.cell_size / method.scene.particles_per_axis_of(material);
  const bool tears = may_tear(method, material);
  return runtime::task("sample state: " + method.materials[static_cast<std::size_t>(material)].name)
      .over_patches_and_groups({material})
      .reads(particle::id.previous(), particle::position<D>.previous(), particle::volume.previous(),
             particle::mass.previous(), particle::velocity<D>.previous(), particle::stress<D>.previous(),
             particle::deformation_gradient<D>.previous())
      .computes(cell::pressure)
      .reduces(state_sample)
      .body([=](const TaskContext& at, auto data) {
        sample_pressures<D>(at, data);
        if (tears) sample_torn<D>(at, spacing, data);
      });
}

}  // namespace

template <int D>
runtime::TaskList sample_tasks(const Method<D>& method)
{
  runtime::TaskList tasks;
  for (const int material : method.deformable_materials) tasks.push_back(sample(method, material));
  return tasks;
}

template <int D>
runtime::HostData sample_data()
{
  return {{&particle::id, &particle::position<D>, &particle::volume, &particle::mass, &particle::velocity<D>,
           &particle::stress<D>, &particle::deformation_gradient<D>},
          {&state_sample, &cell::pressure}};
}

template runtime::HostData sample_data<2>();
template runtime::HostData sample_data<3>();
template runtime::TaskList sample_tasks(const Method<2>&);
template runtime::TaskList sample_tasks(const Method<3>&);

}  // namespace tamp::tasks
