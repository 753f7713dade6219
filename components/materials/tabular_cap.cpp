#include "components/materials/tabular_cap.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "components/materials/cap_integrator.hpp"

namespace tamp::components
{

TabularCap::TabularCap(TabularCapParameters parameters) : parameters_(std::move(parameters))
{
  const double nu = parameters_.poisson_ratio;
  if (!(nu > -1 && nu < 0.5)) throw BadValue("Poisson's ratio " + std::to_string(nu), "a number between -1 and 0.5");
  shear_ratio_ = 1.5 * (1 - 2 * nu) / (1 + nu);

  const std::span<const double> crush = parameters_.crush_curve.y();
  for (std::size_t i = 0; i < crush.size(); ++i) {
    if (!(crush[i] > (i == 0 ? 0 : crush[i - 1]))) {
      throw BadValue("crush pressure " + std::to_string(crush[i]), "positive pressures that strictly increase",
                     static_cast<std::ptrdiff_t>(i));
    }
  }
  if (!(parameters_.tolerance > 0)) {
    throw BadValue("tolerance " + std::to_string(parameters_.tolerance), "a positive number");
  }
  if (parameters_.max_substeps < 1) {
    throw BadValue("at most " + std::to_string(parameters_.max_substeps) + " substeps", "one or more");
  }
}

double TabularCap::crush_pressure(double plastic_volumetric) const
{
  return parameters_.crush_curve(std::max(plastic_volumetric, 0.0));
}

double TabularCap::bulk_modulus(const CapState& state, double pressure) const
{
  return std::visit(
      [&](const auto& model) {
        return parameters_.elastic_update == ElasticUpdate::state
                   ? model.at(state.elastic_volumetric, state.plastic_volumetric).bulk_modulus
                   : model.rate_modulus(pressure, state.elastic_volumetric, state.plastic_volumetric);
      },
      parameters_.modulus);
}

double TabularCap::pressure(const CapState& state) const
{
  return std::visit(
      [&](const auto& model) { return model.at(state.elastic_volumetric, state.plastic_volumetric).pressure; },
      parameters_.modulus);
}

CapState TabularCap::state_at_pressure(double pressure, double plastic_volumetric) const
{
  return std::visit(
      [&](const auto& model) {
        return CapState{.elastic_volumetric = elastic_volumetric_at(model, pressure, plastic_volumetric),
                        .plastic_volumetric = plastic_volumetric};
      },
      parameters_.modulus);
}

double TabularCap::plastic_volumetric_at_crush(double pressure) const
{
  const PiecewiseLinear& curve = parameters_.crush_curve;
  if (pressure <= curve.y().front()) return 0;
  const auto above = std::lower_bound(curve.y().begin(), curve.y().end(), pressure);
  const auto segment = std::min(static_cast<std::size_t>(above - curve.y().begin()), curve.n_segments()) - 1;
  return curve.x()[segment] + (pressure - curve.y()[segment]) / curve.slope_of_segment(segment);
}

namespace
{

/// A strain increment larger than this in one step is no step of a sound simulation, and is refused.
constexpr double largest_increment = 0.2;

/// What makes an update impossible from the start. A sum is finite if its terms are (and one that overflows is no
/// better).
template <int D>
std::optional<UpdateFault> fault_of(const SymmetricTensor<D>& strain, const SymmetricTensor<D>& stress,
                                    const CapState& state)
{
  const double sum = strain.sum() + stress.sum() + state.elastic_volumetric + state.plastic_volumetric;
  if (!std::isfinite(sum)) return UpdateFault::not_finite;
  if (double_dot(strain, strain) > largest_increment * largest_increment) return UpdateFault::too_large;
  return std::nullopt;
}

}  // namespace

template <int D>
std::optional<UpdateFailure> update(const TabularCap& sand, std::span<const SymmetricTensor<D>> strain_increment,
                                    std::span<const CapState> state_old, std::span<SymmetricTensor<D>> stress,
                                    std::span<CapState> state, std::span<double> bulk_modulus,
                                    std::span<double> plastic_work, UpdateCounts& counts)
{
  std::optional<UpdateFailure> first_failure;
  const auto fail = [&](std::size_t i, UpdateFault fault) {
    if (!first_failure) first_failure = UpdateFailure{i, fault};
    ++counts.failures;
    state[i] = state_old[i];
    ++state[i].n_failures;
    bulk_modulus[i] = state[i].bulk_modulus > 0 ? state[i].bulk_modulus : sand.initial_bulk_modulus();
    plastic_work[i] = 0;
  };
  std::visit(
      [&]<class Model>(const Model& model) {
        CapIntegrator<D, Model> integrator(sand, model);
        for (std::size_t i = 0; i < strain_increment.size(); ++i) {
          if (const auto fault = fault_of<D>(strain_increment[i], stress[i], state_old[i])) {
            fail(i, *fault);
            continue;
          }
          const CapParticle<D> now = integrator.advance(stress[i], state_old[i], strain_increment[i]);
          if (!now.returned) {
            fail(i, UpdateFault::no_return);
            continue;
          }
          bulk_modulus[i] = now.state.bulk_modulus;
          stress[i] = now.deviator - isotropic<n_symmetric<D>>(now.pressure);
          state[i] = now.state;
          plastic_work[i] = now.plastic_work;
        }
        counts.add(integrator.counts());
      },
      sand.parameters().modulus);
  return first_failure;
}

template std::optional<UpdateFailure> update<2>(const TabularCap&, std::span<const SymmetricTensor<2>>,
                                                std::span<const CapState>, std::span<SymmetricTensor<2>>,
                                                std::span<CapState>, std::span<double>, std::span<double>,
                                                UpdateCounts&);
template std::optional<UpdateFailure> update<3>(const TabularCap&, std::span<const SymmetricTensor<3>>,
                                                std::span<const CapState>, std::span<SymmetricTensor<3>>,
                                                std::span<CapState>, std::span<double>, std::span<double>,
                                                UpdateCounts&);

}  // namespace tamp::components
