#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>

#include "components/errors.hpp"
#include "components/loads/time_step.hpp"
#include "components/materials/state_columns.hpp"
#include "components/tensor_lanes.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::MaterialBatch;
using runtime::TaskContext;

namespace
{

/// Particles go to the material in runs of this many: long enough for vector evaluation of moduli, short enough that
/// what lives only within the update stays in the first cache.
constexpr std::size_t batch_size = 256;

/// What the material tells of a batch beside the stress and the state.
struct BatchAnswer {
  std::array<double, batch_size> bulk_modulus;
  std::array<double, batch_size> shear_modulus;
  /// J per m^3 of current volume
  std::array<double, batch_size> plastic_work;
};

/// The particles from `first`, as many as there is room for in `answer`.
template <int D, class Model, class Data>
MaterialBatch<D, typename Model::State> batch_at(std::size_t first, const Data& data, BatchAnswer& answer)
{
  const std::size_t n = std::min(batch_size, data[particle::stress<D>].size() - first);
  MaterialBatch<D, typename Model::State> batch{
      .strain_increment = data[particle::strain_increment<D>].subspan(first, n),
      .deformation_gradient = data[particle::deformation_gradient<D>].subspan(first, n),
      .old_state = {},
      .stress = data[particle::stress<D>].subspan(first, n),
      .state = {},
      .bulk_modulus = std::span(answer.bulk_modulus).first(n),
      .shear_modulus = std::span(answer.shear_modulus).first(n),
      .plastic_work = std::span(answer.plastic_work).first(n)};
  if constexpr (components::has_state<Model>) {
    batch.old_state = data[particle::state<Model>.previous()].subspan(first, n);
    batch.state = data[particle::state<Model>].subspan(first, n);
  }
  return batch;
}

/// What each particle of a batch adds to the totals of the step, and its bound on the next.
struct BatchAccount {
  std::array<double, batch_size> elastic, plastic, viscous, taken_at_end, stable_step;

  /// Adds them up in the order of the particles, whatever lanes they have been worked out in.
  void add_to(StepTotals& totals, std::size_t n) const
  {
    for (std::size_t k = 0; k < n; ++k) {
      totals.elastic += elastic[k];
      totals.plastic += plastic[k];
      totals.viscous += viscous[k];
      totals.taken_at_end += taken_at_end[k];
      // Written so that what is not a number does not pass for a bound.
      totals.stable_step = stable_step[k] >= totals.stable_step ? totals.stable_step : stable_step[k];
    }
  }
};

/// One batch after the material has answered: artificial viscosity, energies, and the bound on the next step.
template <int D, class Data>
void account(const Method<D>& method, double dt, const Data& data, std::size_t first,
             std::span<const SymmetricTensor<D>> old_stress, const BatchAnswer& answer)
{
  const std::size_t n = old_stress.size();
  const auto of_batch = [&](const auto& field) { return field.subspan(first, n); };
  const auto mass = of_batch(data[particle::mass.previous()]);
  const auto velocity = of_batch(data[particle::velocity<D>]);
  const auto old_volumes = of_batch(data[particle::volume.previous()]), volumes = of_batch(data[particle::volume]);
  const auto strains = of_batch(data[particle::strain_increment<D>]);
  const auto stress = of_batch(data[particle::stress<D>]);
  const auto old_viscous_pressure = of_batch(data[particle::viscous_pressure.previous()]);
  const auto viscous_pressure = of_batch(data[particle::viscous_pressure]);
  const auto own_stiffness = of_batch(data[particle::own_stiffness]);
  const std::optional<components::ArtificialViscosity>& viscosity = method.viscosity;
  BatchAccount account;
  for (std::size_t k = 0; k < n; k += n_lanes) {
    const auto lanes = [n, k](const auto& values) { return lanes_at(std::span(values).first(n), k); };
    const Lanes volume = lanes(volumes), old_volume = lanes(old_volumes);
    const SymmetricTensor<D, Lanes> strain = lanes(strains);
    const Lanes bulk_modulus = lanes(answer.bulk_modulus);
    const Mask<Lanes> stiff = bulk_modulus > 0.0;
    // Where nothing is stiff nothing has to be damped.
    const Lanes volume_rate = select(stiff, trace(strain) / dt, Lanes(0.0));
    const components::StiffParticle<D, Lanes> p{.density = lanes(mass) / volume,
                                                .bulk_modulus = bulk_modulus,
                                                .shear_modulus = lanes(answer.shear_modulus),
                                                .velocity = lanes(velocity),
                                                .volume_rate = volume_rate,
                                                .own_stiffness = lanes(own_stiffness)};
    const Lanes q = viscosity ? viscosity->pressure(p.density, p.bulk_modulus, p.volume_rate, method.cell_size) : 0.0;
    set_lanes(viscous_pressure, k, q);

    // Work at the middle of the step. What the viscous pressure of the step before takes in its second half is that of
    // the step before: so both pressures have half of this step.
    const Lanes mid_volume = 0.5 * (old_volume + volume);
    const SymmetricTensor<D, Lanes> mid_stress = Lanes(0.5) * (lanes(old_stress) + lanes(stress));
    const Lanes plastic = lanes(answer.plastic_work) * volume;
    set_lanes(account.elastic, k, double_dot(mid_stress, strain) * mid_volume - plastic);
    set_lanes(account.plastic, k, plastic);
    set_lanes(account.viscous, k, 0.5 * (lanes(old_viscous_pressure) + q) * (old_volume - volume));
    set_lanes(account.taken_at_end, k,
              0.5 * (double_dot(lanes(stress), strain) * mid_volume + q * (old_volume - volume)));
    const Lanes stable_step =
        method.time_step_rule == StepRule::published
            ? components::published_time_step<D>(
                  method.cell_size, components::wave_speed(p.bulk_modulus, p.shear_modulus, p.density), p.velocity)
            : components::viscous_time_step<D>(
                  method.cell_size, p, viscosity.value_or(components::ArtificialViscosity{0, 0}), method.amplification);
    set_lanes(account.stable_step, k, select(stiff, stable_step, components::part_of_step_apart * stable_step));
  }
  account.add_to(data[step_totals], n);
}

/// Throws SimulationError for the first of `n` particles whose stress or velocity is not finite.
template <int D, class Data>
void check_finite(const Method<D>& method, int material, const Data& data, std::size_t first, std::size_t n)
{
  const auto stress = data[particle::stress<D>];
  const auto velocity = data[particle::velocity<D>];
  for (std::size_t p = first; p < first + n; ++p) {
    if (stress[p].allFinite() && velocity[p].allFinite()) continue;
    const Vector<D>& x = data[particle::position<D>][p];
    throw SimulationError("stress or velocity is not finite", method.materials[static_cast<std::size_t>(material)].name,
                          data[particle::id.previous()][p], {x.begin(), x.end()});
  }
}

/// What is known of the particle that a batch of a material failed with.
template <int D, class Model, class Data>
FailedUpdate failed_update(const Model& model, int material, std::size_t p, components::UpdateFault fault,
                           const Data& data)
{
  const SymmetricTensor<D>& strain = data[particle::strain_increment<D>][p];
  const SymmetricTensor<D> shape = deviator(strain);
  const components::Invariants stress = components::invariants(data[particle::stress<D>][p]);
  FailedUpdate failed{.particle = data[particle::id.previous()][p],
                      .material = material,
                      .fault = fault,
                      .pressure = stress.pressure,
                      .q = stress.q(),
                      .volumetric_increment = -trace(strain),
                      .deviatoric_increment = std::sqrt(double_dot(shape, shape))};
  if constexpr (components::has_state<Model>) {
    std::size_t k = 0;
    for (const auto& column : components::state_columns<Model>()) {
      failed.state[k++] = column.value(model, data[particle::state<Model>][p], stress);
    }
  }
  const Vector<D>& x = data[particle::position<D>][p];
  std::copy(x.begin(), x.end(), failed.position.begin());
  return failed;
}

/// What bears no stress cannot stop the motion within it: it forgets that, and brings the grid its velocity alone.
template <int D, class Data>
void forget_gradients(const Data& data, std::size_t first, std::span<const double> bulk_modulus)
{
  const auto gradient = data[particle::velocity_gradient<D>];
  if (gradient.empty()) return;
  for (std::size_t k = 0; k < bulk_modulus.size(); ++k) {
    if (bulk_modulus[k] == 0) gradient[first + k].setZero();
  }
}

/// Takes all particles to the material batch by batch.
template <int D, class Model, class Data>
void update_batches(const Method<D>& method, const Model& model, const TaskContext& at, const Data& data)
{
  StepTotals& totals = data[step_totals];
  std::array<SymmetricTensor<D>, batch_size> old_stress;
  BatchAnswer answer;
  for (std::size_t first = 0; first < data[particle::stress<D>].size(); first += batch_size) {
    const auto batch = batch_at<D, Model>(first, data, answer);
    const std::size_t n = batch.stress.size();
    std::copy(batch.stress.begin(), batch.stress.end(), old_stress.begin());
    if (const auto failure = update(model, batch, totals.updates)) {
      totals.failed =
          std::min(totals.failed, failed_update<D>(model, at.group, first + failure->particle, failure->fault, data));
    }
    check_finite(method, at.group, data, first, n);
    account(method, at.step.size, data, first, std::span<const SymmetricTensor<D>>(old_stress.data(), n), answer);
    forget_gradients<D>(data, first, batch.bulk_modulus);
  }
}

template <int D, class Model, class Task>
runtime::TaskDeclaration with_body(const Method<D>& method, const Model& model, Task task)
{
  const auto body = [&method, &model](const TaskContext& at, auto data) { update_batches(method, model, at, data); };
  if constexpr (components::has_state<Model>) {
    return std::move(task).reads(particle::state<Model>.previous()).computes(particle::state<Model>).body(body);
  } else {
    return std::move(task).body(body);
  }
}

/// Where particles take the velocity of the nodes, these have slowed the motion within what comes apart.
template <class Model>
bool forgets_gradients(const Model& model, const Scene& scene)
{
  if constexpr (requires { model.may_come_apart(); }) {
    return model.may_come_apart() && scene.transfer == Transfer::affine && scene.stress_timing != StressTiming::usf;
  } else {
    return false;
  }
}

template <int D, class Model>
runtime::TaskDeclaration update_of(const Method<D>& method, int material, const Model& model)
{
  using runtime::StepEnd;
  // Where stress comes first, particles have yet to move.
  const StepEnd end = method.stress_timing == StressTiming::usf ? StepEnd::start : StepEnd::end;
  return with_body(
      method, model,
      runtime::task("update stress: " + method.materials[static_cast<std::size_t>(material)].name)
          .over_patches_and_groups({material})
          .reads(particle::id.previous(), particle::mass.previous(), particle::deformation_gradient<D>,
                 particle::volume.previous(), particle::volume, particle::viscous_pressure.previous(),
                 particle::own_stiffness, particle::strain_increment<D>, particle::position<D>.at(end),
                 particle::velocity<D>.at(end))
          .updates(particle::stress<D>, particle::velocity_gradient<D>.when(forgets_gradients(model, method.scene)))
          .computes(particle::viscous_pressure)
          .reduces(step_totals));
}

/// Particles deform, where moving them has not done that, and their materials answer.
template <int D>
runtime::TaskList answer_of_materials(const Method<D>& method)
{
  runtime::TaskList tasks = deform_by_carried_velocities(method);
  for (runtime::TaskDeclaration& task : deform_as_cells(method)) tasks.push_back(std::move(task));
  for (const int material : method.deformable_materials) {
    tasks.push_back(std::visit([&](const auto& model) { return update_of(method, material, model); },
                               method.materials[static_cast<std::size_t>(material)].model));
  }
  return tasks;
}

}  // namespace

template <int D>
runtime::TaskList update_stress_first(const Method<D>& method)
{
  return method.stress_timing == StressTiming::usf ? answer_of_materials(method) : runtime::TaskList{};
}

template <int D>
runtime::TaskList update_stress_last(const Method<D>& method)
{
  return method.stress_timing == StressTiming::usf ? runtime::TaskList{} : answer_of_materials(method);
}

template runtime::TaskList update_stress_first(const Method<2>&);
template runtime::TaskList update_stress_first(const Method<3>&);
template runtime::TaskList update_stress_last(const Method<2>&);
template runtime::TaskList update_stress_last(const Method<3>&);

}  // namespace tamp::tasks
