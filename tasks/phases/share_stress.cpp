#include "components/anti_locking/cell_average.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// The stress that particles share: of the start of the step, or as this step has made it.
template <int D>
runtime::StepEnd end_of_stress(const Method<D>& method)
{
  return method.stress_timing == StressTiming::usf ? runtime::StepEnd::end : runtime::StepEnd::start;
}

/// Weighted by the volumes that changes of volume are weighted by, so that the work of both is the same. The stresses
/// are those along the axes that share a change.
template <int D, int n_axes>
runtime::TaskDeclaration average(const Method<D>& method)
{
  const runtime::StepEnd end = end_of_stress(method);
  return runtime::task("average stress")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(particle::position<D>.previous(), particle::volume.previous(), particle::stress<D>.at(end),
             particle::viscous_pressure.at(end))
      .computes(cell::mean_stress)
      .body([](const TaskContext& at, auto data) {
        const auto position = data[particle::position<D>.previous()];
        const auto volume = data[particle::volume.previous()];
        const auto stress = data[particle::stress<D>];
        const auto viscous_pressure = data[particle::viscous_pressure];
        const auto cells = data[cell::mean_stress];
        for_each(cells.box(), [&](const runtime::Index& i) { cells[i] = {}; });
        for (std::size_t p = 0; p < stress.size(); ++p) {
          const double own = components::mean_stress<n_axes>(stress[p], viscous_pressure[p]);
          cells[cell_of<D>(at, position[p])].add(volume[p], own);
        }
      });
}

template <int D, int n_axes>
runtime::TaskDeclaration share(const Method<D>& method)
{
  const runtime::StepEnd end = end_of_stress(method);
  return runtime::task("share stress")
      .over_patches_and_groups(method.deformable_materials)
      .sparse()
      .reads(cell::mean_stress, particle::position<D>.previous(), particle::stress<D>.at(end),
             particle::viscous_pressure.at(end))
      .computes(particle::shared_stress<D>)
      .body([](const TaskContext& at, auto data) {
        const auto position = data[particle::position<D>.previous()];
        const auto stress = data[particle::stress<D>];
        const auto viscous_pressure = data[particle::viscous_pressure];
        const auto cells = data[cell::mean_stress];
        const auto shared = data[particle::shared_stress<D>];
        for (std::size_t p = 0; p < stress.size(); ++p) {
          const double mean = cells[cell_of<D>(at, position[p])].mean();
          shared[p] = components::with_mean_stress<n_axes>(stress[p], viscous_pressure[p], mean);
        }
      });
}

}  // namespace

template <int D>
runtime::TaskList share_stress(const Method<D>& method)
{
  if (!method.deforms_as_cells()) return {};
  if (method.axisymmetric) return {average<D, 3>(method), share<D, 3>(method)};
  return {average<D, D>(method), share<D, D>(method)};
}

template runtime::TaskList share_stress(const Method<2>&);
template runtime::TaskList share_stress(const Method<3>&);

}  // namespace tamp::tasks
