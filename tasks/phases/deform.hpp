#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <span>

#include "components/anti_locking/f_bar.hpp"
#include "components/anti_locking/volume_changes.hpp"
#include "components/kinematics/deform.hpp"
#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

/// A particle that cannot follow keeps its shape, and has no strain: the next phase sees that, and the step is refused.
template <int D, class Data>
void leave_undeformed(const Data& data, std::size_t p)
{
  data[particle::deformation_gradient<D>][p] = data[particle::deformation_gradient<D>.previous()][p];
  data[particle::volume][p] = data[particle::volume.previous()][p];
  data[particle::stress<D>][p] = data[particle::stress<D>.previous()][p];
  data[particle::strain_increment<D>][p].setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// Stretches the hoops of a batch that has been deformed in the plane, by `g` = dt v_r / r.
template <class Data>
void stretch_hoops(const Method<2>& method, const Data& data, std::size_t first, std::span<const double> g)
{
  while (!g.empty()) {
    const auto of_batch = [&](const auto& field) { return field.subspan(first, g.size()); };
    const auto stopped_at = components::stretch_hoops(
        method.deformation_update, {.g = g,
                                    .old_stretch = of_batch(data[particle::hoop_stretch.previous()]),
                                    .stretch = of_batch(data[particle::hoop_stretch]),
                                    .volume = of_batch(data[particle::volume]),
                                    .strain_increment = of_batch(data[particle::strain_increment<2>])});
    if (!stopped_at) return;
    const std::size_t p = first + *stopped_at;
    leave_undeformed<2>(data, p);
    data[particle::hoop_stretch][p] = data[particle::hoop_stretch.previous()][p];
    first = p + 1;
    g = g.subspan(*stopped_at + 1);
  }
}

/// Deforms particles by the gradient of the velocity at the middle of the step, over the shape at its start (eqs
/// 54-58), as `g` times dt; the old stress turns with them, and what the material answers is added by the next phase.
template <int D, class Data>
void deform(const Method<D>& method, const Data& data, std::size_t first, std::span<const Matrix<D>> g)
{
  while (!g.empty()) {
    const auto of_batch = [&](const auto& field) { return field.subspan(first, g.size()); };
    const auto stopped_at = components::deform<D>(
        method.deformation_update, {.g = g,
                                    .old_gradient = of_batch(data[particle::deformation_gradient<D>.previous()]),
                                    .old_volume = of_batch(data[particle::volume.previous()]),
                                    .old_stress = of_batch(data[particle::stress<D>.previous()]),
                                    .deformation_gradient = of_batch(data[particle::deformation_gradient<D>]),
                                    .volume = of_batch(data[particle::volume]),
                                    .stress = of_batch(data[particle::stress<D>]),
                                    .strain_increment = of_batch(data[particle::strain_increment<D>])});
    if (!stopped_at) return;
    leave_undeformed<D>(data, first + *stopped_at);
    first += *stopped_at + 1;
    g = g.subspan(*stopped_at + 1);
  }
}

/// Keeps the gradients of a batch until those of the whole patch are known, and adds its changes of volume to its
/// cells.
template <int D, class Data>
void keep(const Method<D>& method, const runtime::TaskContext& at, const Data& data, std::size_t first,
          std::span<const Matrix<D>> g)
{
  const auto position = data[particle::position<D>.previous()];
  const auto volume = data[particle::volume.previous()];
  const auto cells = data[cell::volume_change];
  std::array<double, motion_batch> change;
  components::volume_changes<D>(method.deformation_update, g, std::span(change).first(g.size()));
  for (std::size_t i = 0; i < g.size(); ++i) {
    data[particle::step_gradient<D>][first + i] = g[i];
    cells[cell_of<D>(at, position[first + i])].add(volume[first + i], change[i]);
  }
}

/// Deforms a batch of particles by the gradients of its motion, which it got from `nodes`; or keeps them, where
/// particles deform as their cells do.
template <int D, class Data>
void take_gradients(const Method<D>& method, const runtime::TaskContext& at, const Data& data,
                    const components::GridBlock<D>& block, const components::NodeMotion<D>* nodes,
                    const double* inverse_mass, std::size_t first,
                    std::span<const components::ParticleMotion<D>> motion)
{
  std::array<Matrix<D>, motion_batch> buffer;
  const auto g = std::span(buffer).first(motion.size());
  for (std::size_t i = 0; i < g.size(); ++i) g[i] = at.step.size * motion[i].velocity_gradient;
  if (method.anti_locking == components::AntiLocking::f_bar) {
    std::array<Matrix<D>, motion_batch> at_centre;
    std::array<double, motion_batch> change;
    const auto centres = std::span(at_centre).first(g.size());
    std::ranges::copy(g, centres.begin());
    const auto changes = std::span(change).first(g.size());
    components::centre_gradients<D>(block, nodes, inverse_mass,
                                    data[particle::position<D>.previous()].subspan(first, g.size()), at.step.size,
                                    centres);
    components::volume_changes<D>(method.deformation_update, centres, changes);
    components::set_volume_changes<D>(method.deformation_update, g, changes);
  }
  if (method.deforms_as_cells()) {
    keep<D>(method, at, data, first, g);
  } else {
    deform<D>(method, data, first, g);
  }
  if constexpr (D == 2) {
    if (!method.axisymmetric) return;
    const auto position = data[particle::position<D>.previous()];
    std::array<double, motion_batch> hoop;
    for (std::size_t i = 0; i < g.size(); ++i) hoop[i] = at.step.size * motion[i].velocity[0] / position[first + i][0];
    stretch_hoops(method, data, first, std::span(hoop).first(g.size()));
  }
}

/// How stiff a batch of particles makes its nodes, for the kernel that finds it; 0 where no rule for the step asks.
template <int D, class Data>
components::OwnStiffness own_stiffness_of(const Method<D>& method, const Data& data, const double* inverse_mass,
                                          std::size_t first, std::size_t size)
{
  const auto stiffness = data[particle::own_stiffness].subspan(first, size);
  if (method.time_step_rule == StepRule::viscous) {
    return {data[particle::mass.previous()].subspan(first, size), inverse_mass, stiffness};
  }
  std::ranges::fill(stiffness, 0.0);
  return {};
}

/// Where particles deform as their cells do, these begin empty.
template <class Data>
void clear_cells(const Data& data)
{
  const auto cells = data[cell::volume_change];
  for_each(cells.box(), [&](const runtime::Index& i) { cells[i] = {}; });
}

/// The task with what `take_gradients` and `own_stiffness_of` ask for beside places and masses, where it is this one
/// that deforms particles.
template <int D, class Task>
auto deforming(const Method<D>& method, Task task, bool deforms)
{
  const bool keeps = deforms && method.deforms_as_cells(), finishes = deforms && !method.deforms_as_cells();
  return std::move(task)
      .reads(particle::id.previous().when(deforms), particle::volume.previous().when(deforms),
             particle::stress<D>.previous().when(deforms),
             particle::hoop_stretch.previous().when(deforms && method.axisymmetric))
      .computes(particle::own_stiffness.when(deforms), particle::step_gradient<D>.when(keeps),
                cell::volume_change.when(keeps), particle::deformation_gradient<D>.when(finishes),
                particle::volume.when(finishes), particle::stress<D>.when(finishes),
                particle::strain_increment<D>.when(finishes),
                particle::hoop_stretch.when(finishes && method.axisymmetric));
}

}  // namespace tamp::tasks
