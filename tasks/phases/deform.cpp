#include "tasks/phases/deform.hpp"

#include "tasks/phases/phases.hpp"

namespace tamp::tasks
{

using runtime::TaskContext;

namespace
{

/// Deforms a batch by the gradients that were kept of it, with the changes of volume of its cells.
template <int D, class Data>
void deform_batch(const Method<D>& method, const TaskContext& at, const Data& data, std::size_t first, std::size_t size)
{
  const auto cells = data[cell::volume_change];
  const auto position = data[particle::position<D>.previous()];
  StepGradientBuffer<D> buffer;
  const StepGradients<D> gradients = buffer.first(size, method.axisymmetric);
  std::ranges::copy(data[particle::step_gradient<D>].subspan(first, size), gradients.g.begin());
  if (method.axisymmetric) {
    std::ranges::copy(data[particle::step_hoop].subspan(first, size), gradients.hoop.begin());
  }
  std::array<double, motion_batch> change;
  for (std::size_t i = 0; i < size; ++i) change[i] = cells[cell_of<D>(at, position[first + i])].mean();
  set_volume_changes<D>(method, gradients, std::span(change).first(size));
  deform<D>(method, data, first, gradients);
}

}  // namespace

/// By now each cell knows the mean change of volume of its particles, which all of them take.
template <int D>
runtime::TaskList deform_as_cells(const Method<D>& method)
{
  if (!method.deforms_as_cells()) return {};
  return {runtime::task("deform as cells")
              .over_patches_and_groups(method.deformable_materials)
              .sparse()
              .reads(cell::volume_change, particle::step_gradient<D>, particle::step_hoop.when(method.axisymmetric),
                     particle::id.previous(), particle::position<D>.previous(),
                     particle::deformation_gradient<D>.previous(), particle::volume.previous(),
                     particle::stress<D>.previous(), particle::hoop_stretch.previous().when(method.axisymmetric))
              .computes(particle::deformation_gradient<D>, particle::volume, particle::stress<D>,
                        particle::strain_increment<D>, particle::hoop_stretch.when(method.axisymmetric))
              .body([&method](const TaskContext& at, auto data) {
                const std::size_t n = data[particle::step_gradient<D>].size();
                for (std::size_t first = 0; first < n; first += motion_batch) {
                  deform_batch<D>(method, at, data, first, std::min(motion_batch, n - first));
                }
              })};
}

template runtime::TaskList deform_as_cells(const Method<2>&);
template runtime::TaskList deform_as_cells(const Method<3>&);

}  // namespace tamp::tasks
