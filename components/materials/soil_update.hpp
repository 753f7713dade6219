#pragma once

#include <algorithm>
#include <array>
#include <numbers>
#include <span>

#include "components/materials/gaps.hpp"
#include "components/materials/material_batch.hpp"
#include "components/materials/soil_state.hpp"
#include "components/tensor_lanes.hpp"

/// Common update of the soils that consist of numbers: a trial stress, its return to the strength, and grains that part
/// and meet again. Requirements of a `Response`, with which each of these soils answers in lanes:
///
///  - `trial<D>(old stress, strain increment, state)` gives a SoilTrial;
///  - `returned<D>(trial, state)` gives a SoilReturn;
///  - `stiffness(state, pressure)`, moduli for waves at the end of the step, pressure compression positive;
///  - where it is made for a range, `is_beyond(pressure)`.
namespace tamp::components
{

/// The stress of a step without plastic strain [Pa, tension positive], and the step's secant moduli [Pa].
template <int D>
struct SoilTrial {
  SymmetricTensor<D, Lanes> stress;
  ModuliOf<Lanes> moduli;
  Lanes old_pressure;  ///< at the start, compression positive
};

/// The return of a trial stress: where it ends, and how it flowed.
template <int D>
struct SoilReturn {
  SymmetricTensor<D, Lanes> stress;
  Lanes expansion;   ///< plastic, volumetric
  Lanes equivalent;  ///< sqrt(2/3 de:de) of the plastic strain's deviator
  Lanes work;        ///< work of the stress on the plastic strain [J/m3]
  /// Whether it ended at the greatest mean tension that it bears. The expansion there opens gaps.
  Mask<Lanes> is_torn;
};

/// Elastic energy of a stress [J/m3].
template <int D>
Lanes stored_energy(const SymmetricTensor<D, Lanes>& stress, const ModuliOf<Lanes>& moduli)
{
  const SymmetricTensor<D, Lanes> s = deviator(stress);
  const Lanes mean = trace(stress) / 3.0;
  return 0.5 * mean * mean / moduli.bulk_modulus + 0.25 * double_dot(s, s) / moduli.shear_modulus;
}

/// The update of a batch, `n_lanes` particles at a time.
template <int D, class Response>
class SoilBatch
{
 public:
  SoilBatch(Response response, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts)
      : response_(std::move(response)), batch_(batch), counts_(counts)
  {
  }

  BatchFailure update()
  {
    for (std::size_t i = 0; i < batch_.stress.size(); i += n_lanes) update_lanes(i);
    return first_failure_;
  }

 private:
  using Tensors = SymmetricTensor<D, Lanes>;

  bool may_part() const { return !batch_.opening.empty(); }

  static Tensors chosen(const Mask<Lanes>& condition, const Tensors& yes, const Tensors& no)
  {
    return yes.binaryExpr(no, [&](const Lanes& a, const Lanes& b) { return select(condition, a, b); });
  }

  void update_lanes(std::size_t i)
  {
    const Tensors increment = lanes_at(batch_.strain_increment, i), old = lanes_at(batch_.stress, i);
    const SoilStateOf<Lanes> state = old_state(i);
    const Gaps gaps = may_part() ? Gaps(lanes_at(batch_.old_opening, i), trace(increment)) : Gaps();
    const Tensors strain = may_part() ? chosen(gaps.before, Tensors(Tensors::Zero()), increment) : increment;
    const SoilTrial<D> trial = response_.template trial<D>(old, strain, state);
    SoilReturn<D> now = response_.template returned<D>(trial, state);

    const Mask<Lanes> finite = are_finite(trial.stress) && are_finite(increment);
    const Mask<Lanes> parts = Mask<Lanes>(may_part()) && finite && !gaps.before && now.is_torn && now.expansion > 0.0;
    if (may_part())
      part(i, parts, finite, gaps, stored_energy<D>(old, trial.moduli) + 0.5 * double_dot(old, strain), now);
    const Tensors stress = chosen(finite, now.stress, old);
    set_lanes(batch_.stress, i, stress);
    set_lanes(batch_.plastic_work, i, select(finite, now.work, Lanes(0.0)));
    const SoilStateOf<Lanes> next{
        state.plastic_volumetric + select(finite, gaps.compaction - now.expansion, Lanes(0.0)),
        state.equivalent_plastic + select(finite, now.equivalent, Lanes(0.0))};
    set_state(i, next);
    const Lanes pressure = trace(stress) / -3.0;
    set_moduli(i, response_.stiffness(next, pressure), parts || gaps.still);
    count_lanes(i, finite, gaps.still);
    if constexpr (requires { response_.is_beyond(pressure); }) count_range(i, response_.is_beyond(pressure));
  }

  /// Takes all stress from soil that was torn in this step, and keeps its gap. Its plastic work is `released`: the
  /// energy that it had stored, and the work of the step.
  void part(std::size_t i, const Mask<Lanes>& parts, const Mask<Lanes>& finite, const Gaps& gaps, const Lanes& released,
            SoilReturn<D>& now)
  {
    const Lanes opening = select(parts, now.expansion, gaps.opening);
    set_lanes(batch_.opening, i, select(finite, opening, lanes_at(batch_.old_opening, i)));
    now.work = select(parts, greater_of<Lanes>(released, 0.0), now.work);
    now.expansion = select(parts, Lanes(0.0), now.expansion);
    now.stress = chosen(parts, Tensors(Tensors::Zero()), now.stress);
    counts_.separations += count(parts && first_lanes(std::min(n_lanes, batch_.stress.size() - i)));
  }

  static Mask<Lanes> are_finite(const Tensors& a)
  {
    Mask<Lanes> finite = is_finite(a[0]);
    for (int k = 1; k < n_symmetric<D>; ++k) finite = finite && is_finite(a[k]);
    return finite;
  }

  SoilStateOf<Lanes> old_state(std::size_t i) const
  {
    const auto of_lane = [&](double SoilState::*member) {
      return each_lane(
          [&](std::size_t l) { return batch_.old_state[std::min(i + l, batch_.state.size() - 1)].*member; });
    };
    return {of_lane(&SoilState::plastic_volumetric), of_lane(&SoilState::equivalent_plastic)};
  }

  void set_state(std::size_t i, const SoilStateOf<Lanes>& state)
  {
    for (std::size_t l = 0; l < n_lanes && i + l < batch_.state.size(); ++l) {
      batch_.state[i + l] = {state.plastic_volumetric[l], state.equivalent_plastic[l]};
    }
  }

  void set_moduli(std::size_t i, const ModuliOf<Lanes>& moduli, const Mask<Lanes>& loose)
  {
    set_lanes(batch_.bulk_modulus, i, select(loose, Lanes(0.0), moduli.bulk_modulus));
    set_lanes(batch_.shear_modulus, i, select(loose, Lanes(0.0), moduli.shear_modulus));
  }

  void count_lanes(std::size_t i, const Mask<Lanes>& finite, const Mask<Lanes>& apart)
  {
    for (std::size_t l = 0; l < n_lanes && i + l < batch_.state.size(); ++l) {
      if (!finite[l]) {
        if (!first_failure_) first_failure_ = UpdateFailure{i + l, UpdateFault::not_finite};
        ++counts_.failures;
      } else {
        ++(apart[l] ? counts_.apart : counts_.substeps);
      }
    }
  }

  void count_range(std::size_t i, const Mask<Lanes>& is_beyond)
  {
    const std::size_t n = std::min(n_lanes, batch_.stress.size() - i);
    counts_.with_range += n;
    counts_.extrapolated += count(is_beyond && first_lanes(n));
  }

  Response response_;
  const MaterialBatch<D, SoilState>& batch_;
  UpdateCounts& counts_;
  BatchFailure first_failure_;
};

}  // namespace tamp::components
