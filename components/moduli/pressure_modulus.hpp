#pragma once

#include <algorithm>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "components/curves/monotone_cubic.hpp"

namespace tamp::components
{

/// Bulk modulus as a function of pressure along each unloading curve, constant beyond the curve's ends, linear in
/// plastic strain between curves: the rate form of the report's Table model (Banerjee, Brannon, Fox, Regueiro 2021,
/// PAR-10021867-092020-6). Below the first curve's plastic strain and beyond the last's, that curve holds.
class PressureModulus
{
 public:
  /// One curve for each plastic strain (ascending, the first 0): elastic strain as a function of pressure.
  PressureModulus(std::span<const double> curve_plastic, std::span<const MonotoneCubic> curves);

  double operator()(double pressure, double plastic_volumetric) const
  {
    const double shifted = std::min(std::max(pressure, 0.0), last_pressure_) + pressure_shift_;
    const OctaveCell cell = octave_cell(shifted);
    const auto [k, s] = between(plastic_volumetric);

    const double* const low = &modulus_[(cell.number - first_octave_cell_) * curve_plastic_.size() + k];
    const double* const high = low + curve_plastic_.size();
    const double at_low = low[0] + s * (low[1] - low[0]), at_high = high[0] + s * (high[1] - high[0]);
    return at_low + cell.fraction * (at_high - at_low);
  }

  /// On or between the curves: not beyond their ends, and no more than 0.1 % of strain in tension.
  bool in_range(double pressure, double plastic_volumetric) const
  {
    if (!(plastic_volumetric >= 0 && plastic_volumetric <= curve_plastic_.back())) return false;
    const auto [k, s] = between(plastic_volumetric);
    return pressure <= (1 - s) * end_pressure_[k] + s * end_pressure_[k + 1] && pressure >= least_pressure_;
  }

 private:
  struct Between {
    std::size_t curve;
    double fraction;  // of the way to the next one
  };
  Between between(double plastic_volumetric) const
  {
    const double ep = std::min(std::max(plastic_volumetric, 0.0), curve_plastic_.back());
    std::size_t k = 0;
    while (k + 2 < curve_plastic_.size() && ep >= curve_plastic_[k + 1]) ++k;
    return {k, (ep - curve_plastic_[k]) * per_width_[k]};
  }

  // Pressure nodes are evenly spaced in each octave of (pressure + shift): the leading bits of that number are the
  // cell, the others the place in it.
  static constexpr int octave_bits = 6;  // 64 cells in each octave
  static constexpr int place_bits = 52 - octave_bits;
  struct OctaveCell {
    std::size_t number;
    double fraction;
  };
  static OctaveCell octave_cell(double shifted_pressure)
  {
    const auto bits = std::bit_cast<std::uint64_t>(shifted_pressure);
    const std::uint64_t place = bits & ((std::uint64_t{1} << place_bits) - 1);
    return {static_cast<std::size_t>(bits >> place_bits),
            static_cast<double>(place) * (1.0 / static_cast<double>(std::uint64_t{1} << place_bits))};
  }

  std::vector<double> curve_plastic_;
  std::vector<double> per_width_;     // 1 / distance of a curve to the next
  std::vector<double> modulus_;       // [pressure node][curve]
  std::vector<double> end_pressure_;  // of each curve
  double least_pressure_ = 0;
  double last_pressure_ = 0;
  double pressure_shift_ = 0;
  std::size_t first_octave_cell_ = 0;
};

}  // namespace tamp::components
