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

TangentModuli TabularCap::initial_moduli() const
{
  const double bulk = bulk_modulus({}, 0);
  return {bulk, shear_ratio_ * bulk};
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

double in_range(const TabularCap& sand, const CapState& state, const Invariants&)
{
  return std::visit(
      [&](const auto& model) { return model.in_range(state.elastic_volumetric, state.plastic_volumetric) ? 1.0 : 0.0; },
      sand.parameters().modulus);
}

double outside(const TabularCap& sand, const CapState& state, const Invariants& stress)
{
  const YieldSurface& surface = sand.parameters().yield;
  const double p = stress.pressure, vertex = surface.vertex_pressure();
  const double crush = sand.crush_pressure(state.plastic_volumetric);
  return std::max({stress.sqrt_j2() - surface.limit(p, crush), p - crush, vertex - p, 0.0}) / (crush - vertex);
}

constexpr std::array<StateColumn<TabularCap>, 6> cap_columns{{
    {"elastic_volumetric", "-", [](const auto&, const CapState& s, const auto&) { return s.elastic_volumetric; }},
    {"plastic_volumetric", "-", [](const auto&, const CapState& s, const auto&) { return s.plastic_volumetric; }},
    {"cap", "Pa",
     [](const auto& sand, const CapState& s, const auto&) { return sand.crush_pressure(s.plastic_volumetric); }},
    {"failed_updates", "",
     [](const auto&, const CapState& s, const auto&) { return static_cast<double>(s.n_failures); },
     Shown::in_field_files},
    {"in_range", "", in_range, Shown::by_drive},
    {"outside", "-", outside, Shown::by_drive},
}};
constexpr std::array<StateExtreme, 3> cap_extremes{{{.column = 2}, {.column = 1}, {.column = 1, .greatest = false}}};

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

std::span<const StateColumn<TabularCap>, 6> TabularCap::columns()
{
  return cap_columns;
}

std::span<const StateExtreme, 3> TabularCap::extremes()
{
  return cap_extremes;
}

template <int D>
BatchFailure update(const TabularCap& sand, const MaterialBatch<D, CapState>& batch, UpdateCounts& counts)
{
  BatchFailure first_failure;
  const auto fail = [&](std::size_t i, UpdateFault fault) {
    if (!first_failure) first_failure = UpdateFailure{i, fault};
    ++counts.failures;
    batch.state[i] = batch.old_state[i];
    ++batch.state[i].n_failures;
    const double last = batch.state[i].bulk_modulus;
    batch.bulk_modulus[i] = last > 0 ? last : sand.initial_moduli().bulk_modulus;
    batch.plastic_work[i] = 0;
  };
  std::visit(
      [&]<class Model>(const Model& model) {
        CapIntegrator<D, Model> integrator(sand, model);
        for (std::size_t i = 0; i < batch.stress.size(); ++i) {
          if (const auto fault = fault_of<D>(batch.strain_increment[i], batch.stress[i], batch.old_state[i])) {
            fail(i, *fault);
            continue;
          }
          const CapParticle<D> now = integrator.advance(batch.stress[i], batch.old_state[i], batch.strain_increment[i]);
          if (!now.returned) {
            fail(i, UpdateFault::no_return);
            continue;
          }
          batch.bulk_modulus[i] = now.state.bulk_modulus;
          batch.stress[i] = now.deviator - isotropic<n_symmetric<D>>(now.pressure);
          batch.state[i] = now.state;
          batch.plastic_work[i] = now.plastic_work;
        }
        counts.add(integrator.counts());
      },
      sand.parameters().modulus);
  for (std::size_t i = 0; i < batch.stress.size(); ++i) {
    batch.shear_modulus[i] = sand.shear_ratio() * batch.bulk_modulus[i];
  }
  return first_failure;
}

template BatchFailure update<2>(const TabularCap&, const MaterialBatch<2, CapState>&, UpdateCounts&);
template BatchFailure update<3>(const TabularCap&, const MaterialBatch<3, CapState>&, UpdateCounts&);

}  // namespace tamp::components
