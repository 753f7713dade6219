#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>

#include "components/errors.hpp"
#include "components/loads/stress_account.hpp"
#include "components/materials/hyperelastic_rings.hpp"
#include "components/materials/state_columns.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"

namespace tamp::tasks
{

using components::MaterialBatch;
using runtime::TaskContext;

namespace
{

/// Particles go to the material in runs of this many: long enough for vector evaluation of moduli, short enough that
/// what lives only within the update stays in the first cache.
constexpr std::size_t batch_size = 256;

/// The material's answer for a batch beside the stress and the state.
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
  if (!data[particle::hoop_stretch].empty()) batch.hoop_stretch = data[particle::hoop_stretch].subspan(first, n);
  if (!data[particle::opening].empty()) {
    batch.old_opening = data[particle::opening.previous()].subspan(first, n);
    batch.opening = data[particle::opening].subspan(first, n);
  }
  return batch;
}

using Account = components::StressAccount<batch_size>;

/// Adds the contributions of `n` particles in their order, whatever lanes they were computed in. Returns whether one of
/// them bounds the next step at least as much as the setter so far.
bool add_to(StepTotals& totals, const Account& account, std::size_t n)
{
  const double least_before = totals.setter.bound;
  bool is_least = false;
  for (std::size_t k = 0; k < n; ++k) {
    totals.elastic += account.elastic[k];
    totals.plastic += account.plastic[k];
    totals.viscous += account.viscous[k];
    totals.stress_work_at_end += account.stress_work_at_end[k];
    // Written so that a NaN does not pass for a bound.
    const double stable_step = account.stable_step[k];
    totals.stable_step = stable_step >= totals.stable_step ? totals.stable_step : stable_step;
    totals.greatest_wave_speed = std::max(totals.greatest_wave_speed, account.wave_speed[k]);
    is_least = is_least || stable_step <= least_before;
  }
  return is_least;
}

/// The particle of a batch that bounds the next step most; of equal ones that with the lowest id.
std::size_t setter_among(std::span<const std::int64_t> id, const Account& account)
{
  std::size_t setter = 0;
  for (std::size_t k = 1; k < id.size(); ++k) {
    const double bound = account.stable_step[k], least = account.stable_step[setter];
    if (bound < least || (bound == least && id[k] < id[setter])) setter = k;
  }
  return setter;
}

/// The setter among the `n` particles from `first`.
template <int D, class Data>
StepSetter setter_of_batch(const Method<D>& method, int material, const Data& data, std::size_t first, std::size_t n,
                           const Account& account)
{
  const auto id = data[particle::id.previous()];
  const std::size_t k = setter_among(id.subspan(first, n), account), p = first + k;
  const double density = method.materials[static_cast<std::size_t>(material)].density;
  StepSetter setter{place_of<D>(id[p], material, data[particle::position<D>.previous()][p])};
  setter.bound = account.stable_step[k];
  setter.volume_ratio = data[particle::volume][p] * density / data[particle::mass.previous()][p];
  setter.pressure = components::invariants(data[particle::stress<D>][p]).pressure;
  setter.wave_speed = account.wave_speed[k];
  return setter;
}

/// Accounts for a batch of particles once its material has been updated.
template <int D, class Data>
void account(const Method<D>& method, const TaskContext& at, const Data& data, std::size_t first,
             std::span<const SymmetricTensor<D>> old_stress, const BatchAnswer& answer)
{
  const std::size_t n = old_stress.size();
  const auto of_batch = [&](const auto& field) { return field.subspan(first, n); };
  const components::StressedBatch<D> batch{
      .mass = of_batch(data[particle::mass.previous()]),
      .velocity = of_batch(data[particle::velocity<D>]),
      .old_volume = of_batch(data[particle::volume.previous()]),
      .volume = of_batch(data[particle::volume]),
      .strain_increment = of_batch(data[particle::strain_increment<D>]),
      .old_stress = old_stress,
      .stress = of_batch(data[particle::stress<D>]),
      .old_viscous_pressure = of_batch(data[particle::viscous_pressure.previous()]),
      .own_stiffness = of_batch(data[particle::own_stiffness]),
      .bulk_modulus = std::span(answer.bulk_modulus).first(n),
      .shear_modulus = std::span(answer.shear_modulus).first(n),
      .plastic_work = std::span(answer.plastic_work).first(n)};
  Account account;
  components::account_for_stress({method.cell_size, method.time_step_rule, method.viscosity, method.amplification},
                                 at.step.size, batch, of_batch(data[particle::viscous_pressure]), account);
  StepTotals& totals = data[step_totals];
  if (!add_to(totals, account, n)) return;
  totals.setter = std::min(totals.setter, setter_of_batch(method, at.group, data, first, n, account));
}

/// The record of a particle that could not follow the motion, see `leave_undeformed`, or whose motion is not finite;
/// with its place before the step.
template <int D, class Data>
BadMotion bad_motion(const Method<D>& method, int material, std::size_t p, const Data& data)
{
  BadMotion bad{place_of<D>(data[particle::id.previous()][p], material, data[particle::position<D>.previous()][p]),
                MotionFault::not_finite};
  if (data[particle::velocity<D>][p].allFinite() && !data[particle::strain_increment<D>][p].allFinite()) {
    const bool inverts = components::with_update(method.deformation_update, [](auto update) { return update.inverts; });
    bad.fault = inverts ? MotionFault::inside_out : MotionFault::turned_too_far;
  }
  return bad;
}

/// Looks at `n` particles for those whose strain, stress or velocity is not finite.
template <int D, class Data>
void check_finite(const Method<D>& method, int material, const Data& data, std::size_t first, std::size_t n)
{
  const auto strain = data[particle::strain_increment<D>];
  const auto stress = data[particle::stress<D>];
  const auto velocity = data[particle::velocity<D>];
  BadMotion& worst = data[step_totals].bad_motion;
  for (std::size_t p = first; p < first + n; ++p) {
    if (std::isfinite(strain[p].sum() + stress[p].sum() + velocity[p].sum())) continue;
    worst = std::min(worst, bad_motion<D>(method, material, p, data));
  }
}

/// The particle that a batch of a material failed with.
template <int D, class Model, class Data>
FailedUpdate failed_update(const Model& model, int material, std::size_t p, components::UpdateFault fault,
                           const Data& data)
{
  const SymmetricTensor<D>& strain = data[particle::strain_increment<D>][p];
  const SymmetricTensor<D> shape = deviator(strain);
  const components::Invariants stress = components::invariants(data[particle::stress<D>][p]);
  FailedUpdate failed{
      place_of<D>(data[particle::id.previous()][p], material, data[particle::position<D>.previous()][p]), fault};
  failed.pressure = stress.pressure;
  failed.q = stress.q();
  failed.volumetric_increment = -trace(strain);
  failed.deviatoric_increment = std::sqrt(double_dot(shape, shape));
  if constexpr (components::has_state<Model>) {
    std::size_t k = 0;
    for (const auto& column : components::state_columns<Model>()) {
      failed.state[k++] = column.value(model, data[particle::state<Model>][p], stress);
    }
  }
  return failed;
}

/// Sets the gradients of particles without stress to zero, as nothing stops the motion within them: they bring the grid
/// their velocity alone.
template <int D, class Data>
void forget_gradients(const Data& data, std::size_t first, std::span<const double> bulk_modulus)
{
  const auto gradient = data[particle::velocity_gradient<D>];
  if (gradient.empty()) return;
  for (std::size_t k = 0; k < bulk_modulus.size(); ++k) {
    if (bulk_modulus[k] == 0) gradient[first + k].setZero();
  }
}

/// The answer of the material to a batch.
template <int D, class Model>
components::BatchFailure update_batch(const Method<D>& method, const Model& model,
                                      const MaterialBatch<D, typename Model::State>& batch,
                                      components::UpdateCounts& counts)
{
  if constexpr (D == 2 && components::Hyperelastic<Model>) {
    if (method.axisymmetric) return update_rings(model, batch, counts);
  }
  return update(model, batch, counts);
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
    if (const auto failure = update_batch(method, model, batch, totals.updates)) {
      totals.failed =
          std::min(totals.failed, failed_update<D>(model, at.group, first + failure->particle, failure->fault, data));
    }
    check_finite(method, at.group, data, first, n);
    account(method, at, data, first, std::span<const SymmetricTensor<D>>(old_stress.data(), n), answer);
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

template <class Model>
bool may_separate(const Model& model)
{
  if constexpr (requires { model.may_separate(); }) return model.may_separate();
  return false;
}

/// Whether the update of the material uses the hoop stretch of rings.
template <class Model>
bool asks_for_hoop(const Model& model)
{
  return components::Hyperelastic<Model> ||
         (may_separate(model) && !std::is_same_v<typename Model::State, components::SoilState>);
}

/// Whether particles without stress lose their velocity gradients. Where particles take the velocity of the nodes they
/// need not: the nodes have slowed the motion within matter that separates.
template <class Model>
bool forgets_gradients(const Model& model, const Scene& scene)
{
  return may_separate(model) && components::brings_own_gradients(scene.transfer) &&
         scene.stress_timing != StressTiming::usf;
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
                 particle::own_stiffness, particle::strain_increment<D>, particle::position<D>.previous(),
                 particle::velocity<D>.at(end),
                 particle::hoop_stretch.when(method.axisymmetric && asks_for_hoop(model)),
                 particle::opening.previous().when(components::keeps_gaps(model)))
          .updates(particle::stress<D>, particle::velocity_gradient<D>.when(forgets_gradients(model, method.scene)))
          .computes(particle::viscous_pressure, particle::opening.when(components::keeps_gaps(model)))
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
