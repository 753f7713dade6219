#pragma once

#include <algorithm>
#include <cmath>
#include <tuple>

#include "components/curves/piecewise_linear.hpp"
#include "components/materials/return_point.hpp"
#include "components/moduli/elastic_model.hpp"

namespace tamp::components
{

/// A step of the sand in scalars. Every substep maps the stress deviator s to a s + b e, where e is the strain
/// deviator of the whole step: three products describe the two at the start, and a and b at the end, in the
/// plane and in space alike. A number is that of one particle (double) or of several side by side (Lanes), which get
/// the same bits. Pressures and volumetric strains compression positive.

/// The strain increment of a step.
template <class Number>
struct CapStrainOf {
  Number compaction;   ///< volumetric
  Number deviator_j2;  ///< e:e/2
  Number sqrt_deviator_j2;

  static constexpr auto fields =
      std::tuple(&CapStrainOf::compaction, &CapStrainOf::deviator_j2, &CapStrainOf::sqrt_deviator_j2);
};
using CapStrain = CapStrainOf<double>;

/// A particle on its way through the step.
template <class Number>
struct CapParticleOf {
  Number pressure;
  Number j2;                                ///< s:s/2 [Pa^2]
  Number mixed;                             ///< s:e [Pa]
  Number of_stress = 1.0, of_strain = 0.0;  ///< s = of_stress s_0 + of_strain e, s_0 at the start of the step
  Number elastic_volumetric, plastic_volumetric, equivalent_plastic, bulk_modulus;  ///< see CapState
  Number plastic_work = 0.0;                                                        ///< [J per m3 of current volume]

  static constexpr auto fields =
      std::tuple(&CapParticleOf::pressure, &CapParticleOf::j2, &CapParticleOf::mixed, &CapParticleOf::of_stress,
                 &CapParticleOf::of_strain, &CapParticleOf::elastic_volumetric, &CapParticleOf::plastic_volumetric,
                 &CapParticleOf::equivalent_plastic, &CapParticleOf::bulk_modulus, &CapParticleOf::plastic_work);
};
using CapParticle = CapParticleOf<double>;

/// Trial sqrt(J2) of s + 2 G e from the three products of s and e.
template <class Number>
struct DeviatoricTrialOf {
  Number old_j2, mixed, increment_j2;

  Number sqrt_j2(const Number& shear_modulus) const
  {
    return sqrt(greater_of<Number>(old_j2 + 2.0 * shear_modulus * (mixed + 2.0 * shear_modulus * increment_j2), 0.0));
  }
};

/// A combination of the stress deviator and the strain deviator of a substep: of_stress s + of_strain e.
template <class Number>
struct CombinationOf {
  Number of_stress, of_strain;

  /// The products of s with it.
  DeviatoricTrialOf<Number> trial(const DeviatoricTrialOf<Number>& of) const
  {
    return {of.old_j2, 2.0 * of_stress * of.old_j2 + of_strain * of.mixed,
            of_stress * of_stress * of.old_j2 + of_strain * (of_stress * of.mixed + of_strain * of.increment_j2)};
  }
  /// Its double contraction with another.
  Number double_dot(const CombinationOf& other, const DeviatoricTrialOf<Number>& of) const
  {
    return 2.0 * of_stress * other.of_stress * of.old_j2 +
           (of_stress * other.of_strain + of_strain * other.of_stress) * of.mixed +
           2.0 * of_strain * other.of_strain * of.increment_j2;
  }
};

/// The state form: pressure and modulus after plastic strain d are the surface's; G is the mean of both ends' of the
/// step (trapezoidal rule).
template <class Number, class Model>
struct StatePath {
  const Model& model;
  const PiecewiseLinear& crush_curve;
  double shear_ratio;
  DeviatoricTrialOf<Number> deviatoric;
  Number elastic_trial, plastic_old, modulus_old;

  PathPointOf<Number> operator()(const Number& d) const
  {
    const Number plastic = plastic_old + d;
    const ElasticPointOf<Number> elastic = model.at(Number(elastic_trial - d), plastic);
    const auto crush = crush_curve.at(greater_of<Number>(plastic, 0.0));
    const Number shear = shear_ratio * 0.5 * (modulus_old + elastic.bulk_modulus);
    return {elastic.pressure,
            elastic.coupling - elastic.bulk_modulus,
            crush.value,
            select(plastic > 0.0, crush.slope, Number(0.0)),
            elastic.bulk_modulus,
            shear,
            deviatoric.sqrt_j2(shear)};
  }
};

/// The rate form with one modulus for the step: p = p_trial - K d.
template <class Number>
struct RatePath {
  static constexpr bool constant_moduli = true;

  const PiecewiseLinear& crush_curve;
  Number pressure_trial, plastic_old, bulk_modulus, shear_modulus, trial_sqrt_j2;

  PathPointOf<Number> operator()(const Number& d) const
  {
    const Number plastic = plastic_old + d;
    const auto crush = crush_curve.at(greater_of<Number>(plastic, 0.0));
    return {pressure_trial - bulk_modulus * d,
            -bulk_modulus,
            crush.value,
            select(plastic > 0.0, crush.slope, Number(0.0)),
            bulk_modulus,
            shear_modulus,
            trial_sqrt_j2};
  }
};

}  // namespace tamp::components
