#include "tasks/phases/deform.hpp"

#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

/// By now each cell knows the mean change of volume of its particles, which all of them take.
template <int D>
runtime::TaskList deform_as_cells(const Method<D>& method)
{
  if (!method.deforms_as_cells()) return {};
  return {runtime::task("deform as cells")
              .over_patches_and_groups(method.deformable_materials)
              .sparse()
              .reads(cell::volume_change, particle::step_gradient<D>, particle::id.previous(),
                     particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
                     particle::volume.previous(), particle::stress<D>.previous())
              .computes(particle::deformation_gradient<D>, particle::volume, particle::stress<D>,
                        particle::strain_increment<D>)
              .body([&method](const TaskContext& at, auto data) {
                const auto cells = data[cell::volume_change];
                const auto position = data[particle::position<D>.previous()];
                const auto own = data[particle::step_gradient<D>];
                std::array<Matrix<D>, motion_batch> gradients;
                std::array<double, motion_batch> changes;
                for (std::size_t first = 0; first < own.size(); first += motion_batch) {
                  const std::size_t size = std::min(motion_batch, own.size() - first);
                  const auto g = std::span(gradients).first(size);
                  const auto change = std::span(changes).first(size);
                  std::copy_n(own.begin() + static_cast<std::ptrdiff_t>(first), size, g.begin());
                  for (std::size_t i = 0; i < size; ++i) {
                    change[i] = cells[cell_of<D>(at, position[first + i])].mean();
                  }
                  components::set_volume_changes<D>(method.deformation_update, g, change);
                  deform<D>(method, data, first, g);
                }
              })};
}

template runtime::TaskList deform_as_cells(const Method<2>&);
template runtime::TaskList deform_as_cells(const Method<3>&);

}  // namespace tamp::tasks
