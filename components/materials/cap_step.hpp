#pragma once

#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <tuple>

#include "components/materials/cap_flow.hpp"
#include "components/materials/cap_path.hpp"
#include "components/materials/tabular_cap.hpp"

namespace tamp::components
{

/// Result of a substep.
template <class Number>
struct CapOutcomeOf {
  CapParticleOf<Number> now;
  Number error;  ///< estimated, of the stress, relative; infinite where no stress was found

  static constexpr auto fields = std::tuple(&CapOutcomeOf::now, &CapOutcomeOf::error);
};
using CapOutcome = CapOutcomeOf<double>;

/// The formulas of a substep of one sand with one elastic model. `size` is the part of the step's strain that it takes.
template <class Model>
class CapStep
{
 public:
  CapStep(const TabularCap& sand, const Model& model)
      : yield_(sand.parameters().yield),
        crush_curve_(sand.parameters().crush_curve),
        model_(model),
        shear_ratio_(sand.shear_ratio()),
        form_(sand.parameters().elastic_update),
        dilation_limit_(sand.parameters().dilation_limit)
  {
  }

  const YieldSurface& yield() const { return yield_; }
  ElasticUpdate form() const { return form_; }
  const Model& model() const { return model_; }

  template <class Number>
  Number crush_pressure(const Number& plastic_volumetric) const
  {
    return crush_curve_.at(greater_of<Number>(plastic_volumetric, 0.0)).value;
  }

  bool ends_dilation() const { return dilation_limit_.has_value(); }
  /// The least plastic volumetric strain that flow on the cone may still add: that of the most dilation, or 0.
  template <class Number>
  Number most_dilation(const CapParticleOf<Number>& old) const
  {
    return lesser_of<Number>(-*dilation_limit_ - old.plastic_volumetric, 0.0);
  }

  /// The products of the stress deviator and that of the substep's strain.
  template <class Number>
  static DeviatoricTrialOf<Number> deviatoric(const CapParticleOf<Number>& old, const CapStrainOf<Number>& strain,
                                              const Number& size)
  {
    return {old.j2, size * old.mixed, size * size * strain.deviator_j2};
  }

  /// The path that is left after a plastic volumetric strain d ahead of the return. `deviatoric` is that of the strain
  /// that is left.
  template <class Number>
  StatePath<Number, Model> state_path(const CapParticleOf<Number>& old, const Number& compaction,
                                      const DeviatoricTrialOf<Number>& deviatoric, const Number& d) const
  {
    return {model_,
            crush_curve_,
            shear_ratio_,
            deviatoric,
            old.elastic_volumetric + compaction - d,
            old.plastic_volumetric + d,
            old.bulk_modulus};
  }

  /// The end of the substep in rate form, with the modulus of the step's middle, where the plastic strain is d_middle.
  template <class Number>
  RatePath<Number> rate_path(const CapParticleOf<Number>& old, const Number& compaction,
                             const DeviatoricTrialOf<Number>& deviatoric, const Number& d, const Number& d_middle) const
  {
    const Number elastic = 0.5 * compaction - d_middle;
    const Number modulus =
        model_.rate_modulus(Number(old.pressure + old.bulk_modulus * elastic), Number(old.elastic_volumetric + elastic),
                            Number(old.plastic_volumetric + d_middle));
    const Number shear = shear_ratio_ * modulus;
    return {crush_curve_,
            old.pressure + modulus * (compaction - d),
            old.plastic_volumetric + d,
            modulus,
            shear,
            deviatoric.sqrt_j2(shear)};
  }

  template <class Number>
  CapOutcomeOf<Number> after_elastic(const CapParticleOf<Number>& old, const CapStrainOf<Number>& strain,
                                     const Number& size, const PathPointOf<Number>& trial) const
  {
    const CombinationOf<Number> deviator{1.0, 2.0 * trial.shear_modulus};
    CapParticleOf<Number> now = with_deviator(old, strain, size, deviator);
    now.pressure = trial.pressure;
    now.j2 = trial.trial_sqrt_j2 * trial.trial_sqrt_j2;
    now.elastic_volumetric = old.elastic_volumetric + size * strain.compaction;
    now.bulk_modulus = trial.bulk_modulus;
    const Number error = modulus_error(old, strain, size, trial.pressure, trial) /
                         error_scale(old, trial.pressure, trial.trial_sqrt_j2, trial);
    return {now, finite_or_infinite<Number>(trial.pressure + error, error)};
  }

  /// The end of a step that flowed: the stress deviator was `along` when that started, and `left` is the deviatoric
  /// strain without the plastic strain that was taken off it ahead of the return.
  template <class Number>
  CapOutcomeOf<Number> after_flow(const CapParticleOf<Number>& old, const CapStrainOf<Number>& strain,
                                  const Number& size, const FlowStartOf<Number>& start,
                                  const CombinationOf<Number>& along, const CombinationOf<Number>& left,
                                  const ReturnPointOf<Number>& point) const
  {
    const Number d = start.plastic_volumetric + point.plastic_volumetric, trial = point.at.trial_sqrt_j2;
    const Number two_shear = 2.0 * point.at.shear_modulus;
    const CombinationOf<Number> trial_deviator{1.0 + two_shear * left.of_stress, two_shear * left.of_strain};
    const Number scaled = select(trial > 0.0, point.sqrt_j2 / trial, Number(1.0));
    const CombinationOf<Number> deviator{trial_deviator.of_stress * scaled, trial_deviator.of_strain * scaled};

    CapParticleOf<Number> now = with_deviator(old, strain, size, deviator);
    now.pressure = point.at.pressure;
    now.j2 = point.sqrt_j2 * point.sqrt_j2;
    now.elastic_volumetric = old.elastic_volumetric + size * strain.compaction - d;
    now.plastic_volumetric = old.plastic_volumetric + d;
    now.equivalent_plastic = old.equivalent_plastic + (start.multiplier + point.multiplier) * (1 / std::numbers::sqrt3);
    now.bulk_modulus = point.at.bulk_modulus;
    // Each half of the flow works at its own end of the step, where the stress is on the surface: that is never
    // negative, as the surface is convex around zero. At the apex flow has one direction, and the mean pressure is more
    // accurate.
    const bool at_apex = point.status == ReturnStatus::apex;
    const Number flow_pressure = at_apex ? Number(0.5 * (start.pressure + now.pressure)) : now.pressure;
    now.plastic_work = old.plastic_work + start.pressure * start.plastic_volumetric + start.sqrt_j2 * start.multiplier +
                       flow_pressure * point.plastic_volumetric + point.sqrt_j2 * point.multiplier;

    Number error = modulus_error(old, strain, size, now.pressure, point.at);
    const auto cosine = [&] {
      // A deviator of nothing but round-off has no direction.
      const Mask<Number> sheared = start.sqrt_j2 > cap_return::no_shear * point.at.crush_pressure && trial > 0.0;
      const Number product = along.double_dot(trial_deviator, deviatoric(old, strain, size));
      return select(sheared, product / (2.0 * start.sqrt_j2 * trial), Number(1.0));
    };
    if (point.status == ReturnStatus::cone_or_cap) error += flow_error(start, point, Number(cosine()));
    if (point.status == ReturnStatus::end_of_dilation) error += shear_error(point, Number(cosine()));
    error = error / error_scale(old, now.pressure, point.sqrt_j2, point.at);
    if (point.status == ReturnStatus::failed) error = no_stress;
    return {now, finite_or_infinite<Number>(now.pressure + point.sqrt_j2 + error, error)};
  }

 private:
  static constexpr double no_stress = std::numeric_limits<double>::infinity();

  template <class Number>
  static Number finite_or_infinite(const Number& sum, const Number& error)
  {
    return select(is_finite(sum), error, Number(no_stress));
  }

  /// Takes the stress deviator to `deviator`, but for its J2.
  template <class Number>
  static CapParticleOf<Number> with_deviator(const CapParticleOf<Number>& old, const CapStrainOf<Number>& strain,
                                             const Number& size, const CombinationOf<Number>& deviator)
  {
    const Number of_strain = deviator.of_strain * size;  // of the whole step's
    CapParticleOf<Number> now = old;
    now.mixed = deviator.of_stress * old.mixed + 2.0 * of_strain * strain.deviator_j2;
    now.of_stress = deviator.of_stress * old.of_stress;
    now.of_strain = deviator.of_stress * old.of_strain + of_strain;
    return now;
  }

  template <class Number>
  static Number error_scale(const CapParticleOf<Number>& old, const Number& pressure, const Number& sqrt_j2,
                            const PathPointOf<Number>& at)
  {
    return greater_of<Number>(greater_of(old.pressure, pressure), greater_of<Number>(sqrt_j2, 0.1 * at.crush_pressure));
  }

  /// The error of taking one modulus for the whole step [Pa]: in the deviator and, in rate form, in the pressure too.
  template <class Number>
  Number modulus_error(const CapParticleOf<Number>& old, const CapStrainOf<Number>& strain, const Number& size,
                       const Number& pressure, const PathPointOf<Number>& at) const
  {
    Number change = (at.bulk_modulus - old.bulk_modulus) / (at.bulk_modulus + old.bulk_modulus);
    Number stress = 2.0 * at.shear_modulus * size * strain.sqrt_deviator_j2;
    if (form_ == ElasticUpdate::rate) {
      // This modulus is of the step's middle, the old one may be of its start.
      change = 2.0 * change;
      stress = stress + abs(Number(pressure - old.pressure));
    }
    return change * change * stress;
  }

  const YieldSurface& yield_;
  const PiecewiseLinear& crush_curve_;
  const Model& model_;
  double shear_ratio_;
  ElasticUpdate form_;
  std::optional<double> dilation_limit_;
};

}  // namespace tamp::components
