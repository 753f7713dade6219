#include "components/relief/cell_average.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// The task with the stress that it looks at: of the start of the step, or as this step has made it.
template <int D, class Body>
runtime::TaskDeclaration with_stress(const Method<D>& method, auto task, const Body& body)
{
  auto placed = std::move(task).reads(particle::position<D>.previous());
  if (method.stress_timing == StressTiming::usf) {
    return std::move(placed).reads(particle::stress<D>, particle::viscous_pressure).body(body);
  }
  return std::move(placed).reads(particle::stress<D>.previous(), particle::viscous_pressure.previous()).body(body);
}

/// Weighted by the volumes that changes of volume are weighted by, so that the work of both is the same.
template <int D>
runtime::TaskDeclaration average(const Method<D>& method)
{
  auto task = runtime::task("average stress")
                  .over_patches_and_groups(method.deformable_materials)
                  .sparse()
                  .reads(particle::volume.previous())
                  .computes(cell::mean_stress);
  return with_stress(method, std::move(task), [](const TaskContext& at, auto data) {
    const auto position = data[particle::position<D>.previous()];
    const auto volume = data[particle::volume.previous()];
    const auto stress = newest(data, particle::stress<D>);
    const auto viscous_pressure = newest(data, particle::viscous_pressure);
    const auto cells = data[cell::mean_stress];
    for_each(cells.box(), [&](const runtime::Index& i) { cells[i] = {}; });
    for (std::size_t p = 0; p < stress.size(); ++p) {
      const double own = components::mean_stress<D>(stress[p], viscous_pressure[p]);
      cells[cell_of<D>(at, position[p])].add(volume[p], own);
    }
  });
}

template <int D>
runtime::TaskDeclaration share(const Method<D>& method)
{
  auto task = runtime::task("share stress")
                  .over_patches_and_groups(method.deformable_materials)
                  .sparse()
                  .reads(cell::mean_stress)
                  .computes(particle::shared_stress<D>);
  return with_stress(method, std::move(task), [](const TaskContext& at, auto data) {
    const auto position = data[particle::position<D>.previous()];
    const auto stress = newest(data, particle::stress<D>);
    const auto viscous_pressure = newest(data, particle::viscous_pressure);
    const auto cells = data[cell::mean_stress];
    const auto shared = data[particle::shared_stress<D>];
    for (std::size_t p = 0; p < stress.size(); ++p) {
      const double mean = cells[cell_of<D>(at, position[p])].mean();
      shared[p] = components::with_mean_stress<D>(stress[p], viscous_pressure[p], mean);
    }
  });
}

}  // namespace

template <int D>
std::vector<runtime::TaskDeclaration> share_stress(const Method<D>& method)
{
  return {average(method), share(method)};
}

template std::vector<runtime::TaskDeclaration> share_stress(const Method<2>&);
template std::vector<runtime::TaskDeclaration> share_stress(const Method<3>&);

}  // namespace tamp::tasks
