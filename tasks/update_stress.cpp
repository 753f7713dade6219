#include <algorithm>
#include <array>
#include <cmath>

#include "components/errors.hpp"
#include "components/loads/time_step.hpp"
#include "components/materials/wave_speed.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases.hpp"
#include "tasks/simulation_error.hpp"

namespace tamp::tasks
{

using components::CapState;
using runtime::TaskContext;

namespace
{

/// Particles go to the material in runs of this many: long enough for vector evaluation of moduli, short enough that
/// what lives only within the update stays in the first cache.
constexpr std::size_t batch_size = 256;

/// What the material tells of a batch beside the stress.
struct BatchAnswer {
  std::array<double, batch_size> bulk_modulus;
  std::array<double, batch_size> shear_modulus;
  /// J per m^3 of current volume
  std::array<double, batch_size> plastic_work;
};

template <int D>
struct StressArguments {
  template <class Data>
  explicit StressArguments(const Data& data)
      : id(data[particle::id.previous()]),
        mass(data[particle::mass.previous()]),
        position(data[particle::position<D>]),
        velocity(data[particle::velocity<D>]),
        old_volume(data[particle::volume.previous()]),
        volume(data[particle::volume]),
        old_viscous_pressure(data[particle::viscous_pressure.previous()]),
        own_stiffness(data[particle::own_stiffness]),
        strain(data[particle::strain_increment<D>]),
        stress(data[particle::stress<D>]),
        viscous_pressure(data[particle::viscous_pressure])
  {
  }

  std::span<const std::int64_t> id;
  std::span<const double> mass;
  std::span<const Vector<D>> position;
  std::span<const Vector<D>> velocity;
  std::span<const double> old_volume;
  std::span<const double> volume;
  std::span<const double> old_viscous_pressure;
  std::span<const double> own_stiffness;
  std::span<const SymmetricTensor<D>> strain;
  std::span<SymmetricTensor<D>> stress;
  std::span<double> viscous_pressure;
};

/// One batch after the material has answered: artificial viscosity, energies, and the bound on the next step.
template <class Interpolator, int D = Interpolator::dimension>
void account(const Method<Interpolator>& method, double dt, const StressArguments<D>& s, std::size_t first,
             std::span<const SymmetricTensor<D>> old_stress, const BatchAnswer& answer, StepTotals& totals)
{
  for (std::size_t k = 0; k < old_stress.size(); ++k) {
    const std::size_t p = first + k;
    const double bulk = answer.bulk_modulus[k], shear = answer.shear_modulus[k];
    const double density = s.mass[p] / s.volume[p];
    const double volume_rate = trace(s.strain[p]) / dt;
    s.viscous_pressure[p] =
        method.viscosity ? method.viscosity->pressure(density, bulk, volume_rate, method.cell_size) : 0;

    // Work at the middle of the step; the viscous pressure that acted was that of the step before.
    const double mid_volume = 0.5 * (s.old_volume[p] + s.volume[p]);
    const SymmetricTensor<D> mid_stress = 0.5 * (old_stress[k] + s.stress[p]);
    const double plastic = answer.plastic_work[k] * s.volume[p];
    totals.elastic += double_dot(mid_stress, s.strain[p]) * mid_volume - plastic;
    totals.plastic += plastic;
    totals.viscous += s.old_viscous_pressure[p] * (s.old_volume[p] - s.volume[p]);

    const double bound =
        method.time_step_rule == StepRule::published
            ? components::published_time_step<D>(method.cell_size, components::wave_speed(bulk, shear, density),
                                                 s.velocity[p])
            : components::viscous_time_step<D>(method.cell_size,
                                               {density, bulk, shear, s.velocity[p], volume_rate, s.own_stiffness[p]},
                                               method.viscosity.value_or(components::ArtificialViscosity{0, 0}));
    // Written so that what is not a number does not pass for a bound.
    totals.stable_step = bound >= totals.stable_step ? totals.stable_step : bound;
  }
}

/// Takes all particles to the material batch by batch; `update(first, n, answer)` updates the stress in place.
template <class Interpolator, int D, class Update>
void in_batches(const Method<Interpolator>& method, const TaskContext& at, const StressArguments<D>& s,
                StepTotals& totals, const Update& update)
{
  // Here, as this task runs on every patch, with particles or without.
  totals.host_requests = at.step.host_requests;
  std::array<SymmetricTensor<D>, batch_size> old_stress;
  BatchAnswer answer;
  for (std::size_t first = 0; first < s.id.size(); first += batch_size) {
    const std::size_t n = std::min(batch_size, s.id.size() - first);
    std::copy_n(s.stress.begin() + static_cast<std::ptrdiff_t>(first), n, old_stress.begin());
    update(first, n, answer);
    for (std::size_t p = first; p < first + n; ++p) {
      if (s.stress[p].allFinite() && s.velocity[p].allFinite()) continue;
      throw SimulationError("stress or velocity is not finite",
                            method.materials[static_cast<std::size_t>(at.group)].name, s.id[p],
                            {s.position[p].begin(), s.position[p].end()});
    }
    account<Interpolator>(method, at.step.size, s, first, std::span<const SymmetricTensor<D>>(old_stress.data(), n),
                          answer, totals);
  }
}

template <int D>
FailedUpdate failed_update(std::int64_t id, int material, components::UpdateFault fault, const Vector<D>& position,
                           const CapState& state, const SymmetricTensor<D>& stress, const SymmetricTensor<D>& strain)
{
  const SymmetricTensor<D> s = deviator(stress), e = deviator(strain);
  FailedUpdate failed{.particle = id,
                      .material = material,
                      .fault = fault,
                      .state = state,
                      .pressure = -trace(stress) / 3,
                      .q = std::sqrt(1.5 * double_dot(s, s)),
                      .volumetric_increment = -trace(strain),
                      .deviatoric_increment = std::sqrt(double_dot(e, e))};
  std::copy(position.begin(), position.end(), failed.position.begin());
  return failed;
}

/// What every material's task reads and makes.
template <int D>
auto stress_task(const std::string& material, int group)
{
  return runtime::task("update stress: " + material)
      .over_patches_and_groups({group})
      .reads(particle::id.previous(), particle::mass.previous(), particle::position<D>, particle::velocity<D>,
             particle::volume.previous(), particle::volume, particle::viscous_pressure.previous(),
             particle::own_stiffness, particle::strain_increment<D>)
      .updates(particle::stress<D>)
      .computes(particle::viscous_pressure)
      .reduces(step_totals);
}

template <class Interpolator>
runtime::TaskDeclaration update(const Method<Interpolator>& method, int group, const std::string& name,
                                const components::Hypoelastic& steel)
{
  constexpr int D = Interpolator::dimension;
  return stress_task<D>(name, group).body([&method, &steel](const TaskContext& at, auto data) {
    const StressArguments<D> s(data);
    StepTotals& totals = data[step_totals];
    in_batches(method, at, s, totals, [&](std::size_t first, std::size_t n, BatchAnswer& answer) {
      std::fill_n(answer.plastic_work.begin(), n, 0.0);
      std::fill_n(answer.bulk_modulus.begin(), n, steel.bulk_modulus);
      std::fill_n(answer.shear_modulus.begin(), n, steel.shear_modulus);
      components::update<D>(steel, s.strain.subspan(first, n), s.stress.subspan(first, n));
    });
  });
}

template <class Interpolator>
runtime::TaskDeclaration update(const Method<Interpolator>& method, int group, const std::string& name,
                                const components::NeoHookean& rubber)
{
  constexpr int D = Interpolator::dimension;
  return stress_task<D>(name, group)
      .reads(particle::deformation_gradient<D>)
      .body([&method, &rubber](const TaskContext& at, auto data) {
        const StressArguments<D> s(data);
        StepTotals& totals = data[step_totals];
        in_batches(method, at, s, totals, [&](std::size_t first, std::size_t n, BatchAnswer& answer) {
          std::fill_n(answer.plastic_work.begin(), n, 0.0);
          components::update<D>(rubber, data[particle::deformation_gradient<D>].subspan(first, n),
                                s.stress.subspan(first, n));
          for (std::size_t k = 0; k < n; ++k) {
            const auto moduli =
                components::tangent_moduli<D>(rubber, data[particle::deformation_gradient<D>][first + k]);
            answer.bulk_modulus[k] = moduli.bulk_modulus;
            answer.shear_modulus[k] = moduli.shear_modulus;
          }
        });
      });
}

template <class Interpolator>
runtime::TaskDeclaration update(const Method<Interpolator>& method, int group, const std::string& name,
                                const components::TabularCap& sand)
{
  constexpr int D = Interpolator::dimension;
  return stress_task<D>(name, group)
      .reads(particle::cap_state.previous())
      .computes(particle::cap_state)
      .body([&method, &sand](const TaskContext& at, auto data) {
        const StressArguments<D> s(data);
        StepTotals& totals = data[step_totals];
        in_batches(method, at, s, totals, [&](std::size_t first, std::size_t n, BatchAnswer& answer) {
          const auto failure = components::update<D>(
              sand, s.strain.subspan(first, n), data[particle::cap_state.previous()].subspan(first, n),
              s.stress.subspan(first, n), data[particle::cap_state].subspan(first, n),
              std::span(answer.bulk_modulus).first(n), std::span(answer.plastic_work).first(n), totals.updates);
          for (std::size_t k = 0; k < n; ++k) answer.shear_modulus[k] = sand.shear_ratio() * answer.bulk_modulus[k];
          if (!failure) return;
          const std::size_t p = first + failure->particle;
          totals.note(failed_update<D>(s.id[p], at.group, failure->fault, s.position[p], data[particle::cap_state][p],
                                       s.stress[p], s.strain[p]));
        });
      });
}

}  // namespace

template <class Interpolator>
runtime::TaskDeclaration update_stress(const Method<Interpolator>& method, int material)
{
  const SceneMaterial& m = method.materials[static_cast<std::size_t>(material)];
  return std::visit([&](const auto& model) { return update(method, material, m.name, model); }, m.model);
}

template runtime::TaskDeclaration update_stress(const Method<components::Gimp<2>>&, int);
template runtime::TaskDeclaration update_stress(const Method<components::Gimp<3>>&, int);

}  // namespace tamp::tasks
