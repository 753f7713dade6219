#include "components/materials/drucker_prager.hpp"

#include "components/materials/constant_soil.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

double slope_of(double angle)
{
  const double sine = portable::sin(in_radians(angle));
  return 2 * std::numbers::sqrt3 * sine / (3 - sine);
}

/// The return of a trial stress: where the square root of J2 ends, and how it flowed.
struct ConeReturn {
  Lanes pressure;
  Lanes sqrt_j2;
  Lanes plastic_shear;  ///< times s / (2 sqrt(J2)) it is the deviator of the plastic strain
  Lanes plastic_expansion;
  Mask<Lanes> is_at_cut_off;
};

/// The response of a Drucker-Prager soil, see SoilBatch.
class ConeResponse
{
 public:
  explicit ConeResponse(const DruckerPrager& soil)
      : soil_(soil),
        alpha_(slope_of(soil.friction_angle)),
        k_(soil.cohesion * 2 * std::numbers::sqrt3 * portable::cos(in_radians(soil.friction_angle)) /
           (3 - portable::sin(in_radians(soil.friction_angle)))),
        beta_(slope_of(soil.dilation_angle)),
        tension_(std::min(soil.tension_cutoff, apex_tension()))
  {
  }

  double tension() const { return tension_; }
  double apex_tension() const { return alpha_ > 0 ? k_ / alpha_ : std::numeric_limits<double>::infinity(); }

  template <int D>
  SoilTrial<D> trial(const SymmetricTensor<D, Lanes>& old, const SymmetricTensor<D, Lanes>& strain,
                     const SoilStateOf<Lanes>& /*state*/) const
  {
    return linear_trial<D>(soil_.initial_moduli(), old, strain);
  }

  template <int D>
  SoilReturn<D> returned(const SoilTrial<D>& trial, const SoilStateOf<Lanes>& state) const
  {
    const SymmetricTensor<D, Lanes> shearing = deviator(trial.stress);
    const Lanes j2 = 0.5 * double_dot(shearing, shearing), tau = sqrt(j2);
    const Mask<Lanes> widens = -state.plastic_volumetric < soil_.dilation_limit;
    const ConeReturn now = to_cone(-trace(trial.stress) / 3, tau, select(widens, Lanes(beta_), Lanes(0.0)));
    const Lanes kept = select(j2 > 0.0, now.sqrt_j2 / tau, Lanes(1.0));
    return {kept * shearing - isotropic<n_symmetric<D>, Lanes>(now.pressure), now.plastic_expansion,
            now.plastic_shear / std::numbers::sqrt3,
            now.sqrt_j2 * now.plastic_shear - now.pressure * now.plastic_expansion, now.is_at_cut_off};
  }

  ModuliOf<Lanes> stiffness(const SoilStateOf<Lanes>& /*state*/, const Lanes& /*pressure*/) const
  {
    return {soil_.bulk_modulus, soil_.shear_modulus};
  }

  template <class Number>
  Number strength(const Number& pressure) const
  {
    return k_ + alpha_ * pressure;
  }

 private:
  /// `tau` is the trial's sqrt(J2).
  ConeReturn to_cone(const Lanes& trial_pressure, const Lanes& tau, const Lanes& beta) const
  {
    const double K = soil_.bulk_modulus, G = soil_.shear_modulus;
    const Lanes zero = 0.0, cut_off = -tension_;
    const Lanes beyond_cone = tau - strength(trial_pressure);
    const Mask<Lanes> is_elastic = beyond_cone <= 0.0 && trial_pressure >= cut_off;

    const Lanes shear = beyond_cone / (G + alpha_ * beta * K);
    const Lanes pressure = trial_pressure + K * beta * shear;
    const Mask<Lanes> is_on_cone = beyond_cone > 0.0 && pressure >= cut_off;
    // Below the cut-off there is shear left; where it is next to nothing, round-off may say less.
    const Lanes left = greater_of<Lanes>(tau - shear * G, zero);
    // At the cut-off, where the cone may hold the shear.
    const Lanes held = lesser_of<Lanes>(tau, greater_of<Lanes>(strength(cut_off), zero));

    const auto chosen = [&](const Lanes& elastic, const Lanes& on_cone, const Lanes& at_cut_off) {
      return select(is_elastic, elastic, select(is_on_cone, on_cone, at_cut_off));
    };
    return {chosen(trial_pressure, pressure, cut_off), chosen(tau, left, held), chosen(zero, shear, (tau - held) / G),
            chosen(zero, beta * shear, (cut_off - trial_pressure) / K), !is_elastic && !is_on_cone};
  }

  const DruckerPrager& soil_;
  double alpha_, k_, beta_;
  double tension_;  ///< the greatest mean tension
};

}  // namespace

std::span<const Parameter<DruckerPrager>, 8> DruckerPrager::parameters()
{
  return constant_soil_parameters<DruckerPrager>;
}

std::span<const StateColumn<DruckerPrager>, 2> DruckerPrager::columns()
{
  return soil_columns<DruckerPrager>;
}

std::span<const StateExtreme, 3> DruckerPrager::extremes()
{
  return soil_extremes;
}

double DruckerPrager::apex_tension() const
{
  return ConeResponse(*this).apex_tension();
}

void DruckerPrager::check() const
{
  check_constant_soil(*this);
}

template <int D>
BatchFailure update(const DruckerPrager& soil, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts)
{
  return SoilBatch<D, ConeResponse>(ConeResponse(soil), batch, counts).update();
}

template BatchFailure update<2>(const DruckerPrager&, const MaterialBatch<2, SoilState>&, UpdateCounts&);
template BatchFailure update<3>(const DruckerPrager&, const MaterialBatch<3, SoilState>&, UpdateCounts&);

SoilState DruckerPrager::settled_state(const SettledStress& settled) const
{
  const ConeResponse cone(*this);
  const Invariants now = invariants(settled.stress);
  check_tension(now.pressure, cone.tension());
  check_is_borne(now, cone.strength(now.pressure));
  return {};
}

}  // namespace tamp::components
