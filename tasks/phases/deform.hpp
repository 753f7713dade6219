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

/// Gradients of the motion of a step, at its middle, for a batch of particles over their shape at its start (eqs
/// 54-58).
template <int D>
struct StepGradients {
  std::span<Matrix<D>> g;  ///< dt times the gradient of the velocity; row: component of velocity
  std::span<double> hoop;  ///< dt v_r / r in axisymmetric scenes; else empty
};

template <int D>
struct StepGradientBuffer {
  std::array<Matrix<D>, motion_batch> g;
  std::array<double, motion_batch> hoop;

  StepGradients<D> first(std::size_t size, bool axisymmetric)
  {
    return {std::span(g).first(size), std::span(hoop).first(axisymmetric ? size : 0)};
  }
};

/// A particle that cannot follow keeps its shape, and has no strain: the next phase sees that, and the step is refused.
template <int D, class Data>
void leave_undeformed(const Data& data, std::size_t p)
{
  data[particle::deformation_gradient<D>][p] = data[particle::deformation_gradient<D>.previous()][p];
  data[particle::volume][p] = data[particle::volume.previous()][p];
  data[particle::stress<D>][p] = data[particle::stress<D>.previous()][p];
  data[particle::strain_increment<D>][p].setConstant(std::numeric_limits<double>::quiet_NaN());
}

/// Stretches the hoops of a batch that has followed its gradients in the plane, by `g` = dt v_r / r.
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

/// Deforms a batch by `g`; the old stress turns with it.
template <int D, class Data>
void follow_gradients(const Method<D>& method, const Data& data, std::size_t first, std::span<const Matrix<D>> g)
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

/// Deforms a batch of particles; the next phase adds the response of the material.
template <int D, class Data>
void deform(const Method<D>& method, const Data& data, std::size_t first, const StepGradients<D>& gradients)
{
  follow_gradients<D>(method, data, first, gradients.g);
  if constexpr (D == 2) {
    if (method.axisymmetric) stretch_hoops(method, data, first, gradients.hoop);
  }
}

/// The changes of volume of particles, or of rings.
template <int D>
void volume_changes(const Method<D>& method, const StepGradients<D>& of, std::span<double> change)
{
  if constexpr (D == 2) {
    if (method.axisymmetric) return components::ring_volume_changes(method.deformation_update, of.g, of.hoop, change);
  }
  components::volume_changes<D>(method.deformation_update, of.g, change);
}

template <int D>
void set_volume_changes(const Method<D>& method, const StepGradients<D>& of, std::span<const double> change)
{
  if constexpr (D == 2) {
    if (method.axisymmetric) {
      return components::set_ring_volume_changes(method.deformation_update, of.g, of.hoop, change);
    }
  }
  components::set_volume_changes<D>(method.deformation_update, of.g, change);
}

/// Keeps the gradients of a batch until those of the whole patch are known, and adds its changes of volume to its
/// cells.
template <int D, class Data>
void keep(const Method<D>& method, const runtime::TaskContext& at, const Data& data, std::size_t first,
          const StepGradients<D>& gradients)
{
  const std::size_t size = gradients.g.size();
  const auto position = data[particle::position<D>.previous()];
  const auto volume = data[particle::volume.previous()];
  const auto cells = data[cell::volume_change];
  std::array<double, motion_batch> change;
  volume_changes<D>(method, gradients, std::span(change).first(size));
  std::ranges::copy(gradients.g, data[particle::step_gradient<D>].subspan(first).begin());
  if (method.axisymmetric) std::ranges::copy(gradients.hoop, data[particle::step_hoop].subspan(first).begin());
  for (std::size_t i = 0; i < size; ++i) {
    cells[cell_of<D>(at, position[first + i])].add(volume[first + i], change[i]);
  }
}

/// Gives a batch the changes of volume at the centres of its cells, by the velocities of `nodes`.
template <int D, class Data>
void take_centre_changes(const Method<D>& method, double dt, const Data& data, const components::GridBlock<D>& block,
                         const components::NodeMotion<D>* nodes, const double* inverse_mass, std::size_t first,
                         const StepGradients<D>& gradients)
{
  const std::size_t size = gradients.g.size();
  StepGradientBuffer<D> buffer;
  const StepGradients<D> centres = buffer.first(size, method.axisymmetric);
  std::array<double, motion_batch> change;
  const auto changes = std::span(change).first(size);
  std::ranges::copy(gradients.g, centres.g.begin());
  std::ranges::copy(gradients.hoop, centres.hoop.begin());
  components::centre_gradients<D>(block, nodes, inverse_mass,
                                  data[particle::position<D>.previous()].subspan(first, size), dt, centres.g,
                                  centres.hoop);
  volume_changes<D>(method, centres, changes);
  set_volume_changes<D>(method, gradients, changes);
}

/// Deforms a batch of particles by the gradients of its motion, which it got from `nodes`; or keeps them, where
/// particles deform as their cells do.
template <int D, class Data>
void take_gradients(const Method<D>& method, const runtime::TaskContext& at, const Data& data,
                    const components::GridBlock<D>& block, const components::NodeMotion<D>* nodes,
                    const double* inverse_mass, std::size_t first,
                    std::span<const components::ParticleMotion<D>> motion)
{
  const double dt = at.step.size;
  const auto position = data[particle::position<D>.previous()];
  StepGradientBuffer<D> buffer;
  const StepGradients<D> gradients = buffer.first(motion.size(), method.axisymmetric);
  for (std::size_t i = 0; i < motion.size(); ++i) gradients.g[i] = dt * motion[i].velocity_gradient;
  for (std::size_t i = 0; i < gradients.hoop.size(); ++i) {
    gradients.hoop[i] = dt * motion[i].velocity[0] / position[first + i][0];
  }
  if (method.anti_locking == components::AntiLocking::f_bar) {
    take_centre_changes<D>(method, dt, data, block, nodes, inverse_mass, first, gradients);
  }
  if (method.deforms_as_cells()) {
    keep<D>(method, at, data, first, gradients);
  } else {
    deform<D>(method, data, first, gradients);
  }
}

/// Stiffness that a batch of particles gives its nodes, for the kernel that computes it; 0 where no rule for the step
/// uses it.
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

/// Clears the sums of cells, where particles deform as their cells do.
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
             particle::hoop_stretch.previous().when(finishes && method.axisymmetric))
      .computes(particle::own_stiffness.when(deforms), particle::step_gradient<D>.when(keeps),
                particle::step_hoop.when(keeps && method.axisymmetric), cell::volume_change.when(keeps),
                particle::deformation_gradient<D>.when(finishes), particle::volume.when(finishes),
                particle::stress<D>.when(finishes), particle::strain_increment<D>.when(finishes),
                particle::hoop_stretch.when(finishes && method.axisymmetric));
}

}  // namespace tamp::tasks
