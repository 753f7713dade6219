#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "components/curves/monotone_cubic.hpp"
#include "components/curves/octave_buckets.hpp"
#include "components/lanes.hpp"

namespace tamp::components
{

/// Bulk modulus as a function of pressure along each unloading curve, constant beyond the curve's ends, linear in
/// plastic strain between curves: the rate form of the report's Table model (Banerjee, Brannon, Fox, Regueiro 2021,
/// PAR-10021867-092020-6). Below the first curve's plastic strain and beyond the last's, that curve holds.
class PressureModulus
{
 public:
  /// Takes a curve for each plastic strain (ascending, the first 0): elastic strain as a function of pressure.
  PressureModulus(std::span<const double> curve_plastic, std::span<const MonotoneCubic> curves);

  template <class Number>
  Number operator()(const Number& pressure, const Number& plastic_volumetric) const
  {
    const BetweenOf<Number> curves = between(plastic_volumetric);
    const auto [low, low_next, high, high_next] = moduli_around(pressure, curves.number);
    const Number at_low = low + curves.fraction * (low_next - low);
    const Number at_high = high + curves.fraction * (high_next - high);
    return at_low + nodes_.place(pressure) * (at_high - at_low);
  }

  /// On or between the curves: not beyond their ends, and no more than 0.1 % of strain in tension.
  template <class Number>
  Mask<Number> in_range(const Number& pressure, const Number& plastic_volumetric) const
  {
    const auto [curve, s] = between(plastic_volumetric);
    const Number end = (1.0 - s) * end_pressure(curve) + s * end_pressure(Number(curve + 1.0));
    return plastic_volumetric >= 0.0 && plastic_volumetric <= curve_plastic_.back() && pressure >= least_pressure_ &&
           pressure <= end;
  }

 private:
  /// The curve below a plastic strain, and how far that is on the way to the next one.
  template <class Number>
  struct BetweenOf {
    Number number, fraction;
  };
  template <class Number>
  BetweenOf<Number> between(const Number& plastic_volumetric) const
  {
    const Number ep = clamped<Number>(plastic_volumetric, 0.0, curve_plastic_.back());
    BetweenOf<Number> at{0.0, ep * per_width_[0]};
    for (std::size_t k = 1; k + 1 < curve_plastic_.size(); ++k) {
      const Mask<Number> beyond = ep >= curve_plastic_[k];
      at.number = select(beyond, Number(static_cast<double>(k)), at.number);
      at.fraction = select(beyond, Number((ep - curve_plastic_[k]) * per_width_[k]), at.fraction);
    }
    return at;
  }

  /// Moduli at the pressure nodes below and above, on the curves below and above.
  template <class Number>
  struct Moduli {
    Number low, low_next, high, high_next;
  };
  Moduli<double> moduli_around(double pressure, double curve) const
  {
    const std::size_t n = curve_plastic_.size();
    const double* const low = &modulus_[nodes_.of(pressure) * n + static_cast<std::size_t>(curve)];
    return {low[0], low[1], low[n], low[n + 1]};
  }
  Moduli<Lanes> moduli_around(const Lanes& pressure, const Lanes& curve) const
  {
    const std::size_t n = curve_plastic_.size();
    const auto node = nodes_.of(pressure);
    const auto number = whole_parts(curve);
    std::array<const double*, n_lanes> low;
    for (std::size_t l = 0; l < n_lanes; ++l) low[l] = &modulus_[node[l] * n + static_cast<std::size_t>(number[l])];
    return {each_lane([&](std::size_t l) { return low[l][0]; }), each_lane([&](std::size_t l) { return low[l][1]; }),
            each_lane([&](std::size_t l) { return low[l][n]; }),
            each_lane([&](std::size_t l) { return low[l][n + 1]; })};
  }

  double end_pressure(double curve) const { return end_pressure_[static_cast<std::size_t>(curve)]; }
  Lanes end_pressure(const Lanes& curve) const
  {
    const auto number = whole_parts(curve);
    return each_lane([&](std::size_t l) { return end_pressure_[static_cast<std::size_t>(number[l])]; });
  }

  std::vector<double> curve_plastic_;
  std::vector<double> per_width_;     // 1 / distance of a curve to the next
  std::vector<double> modulus_;       // [pressure node][curve]
  std::vector<double> end_pressure_;  // of each curve
  double least_pressure_ = 0;
  OctaveBuckets nodes_;  // a pressure node at the start of each
};

}  // namespace tamp::components
