#include "components/moduli/pressure_modulus.hpp"

namespace tamp::components
{

PressureModulus::PressureModulus(std::span<const double> curve_plastic, std::span<const MonotoneCubic> curves)
    : curve_plastic_(curve_plastic.begin(), curve_plastic.end())
{
  for (std::size_t k = 0; k + 1 < curve_plastic_.size(); ++k) {
    per_width_.push_back(1 / (curve_plastic_[k + 1] - curve_plastic_[k]));
  }
  for (const MonotoneCubic& curve : curves) end_pressure_.push_back(curve.x().back());
  last_pressure_ = *std::max_element(end_pressure_.begin(), end_pressure_.end());
  least_pressure_ = -1e-3 / curves.front().at(0).slope;

  pressure_shift_ = last_pressure_ / 4096;
  first_octave_cell_ = octave_cell(pressure_shift_).number;
  // The first node lies at or below pressure zero, where a curve is straight.
  const std::size_t n_cells = octave_cell(last_pressure_ + pressure_shift_).number - first_octave_cell_ + 1;
  for (std::size_t cell = 0; cell <= n_cells; ++cell) {
    const std::uint64_t bits = static_cast<std::uint64_t>(first_octave_cell_ + cell) << place_bits;
    const double p = std::bit_cast<double>(bits) - pressure_shift_;
    for (const MonotoneCubic& curve : curves) modulus_.push_back(1 / curve.at(p).slope);
  }
}

}  // namespace tamp::components
