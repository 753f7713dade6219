#include "components/moduli/pressure_modulus.hpp"

#include <algorithm>

namespace tamp::components
{

namespace
{

/// 64 nodes in each of twelve octaves: close together at low pressures, where the moduli change most.
OctaveBuckets pressure_nodes(std::span<const MonotoneCubic> curves)
{
  double last = 0;
  for (const MonotoneCubic& curve : curves) last = std::max(last, curve.x().back());
  return OctaveBuckets(0, last, last / 4096, 6);
}

}  // namespace

PressureModulus::PressureModulus(std::span<const double> curve_plastic, std::span<const MonotoneCubic> curves)
    : curve_plastic_(curve_plastic.begin(), curve_plastic.end()), nodes_(pressure_nodes(curves))
{
  for (std::size_t k = 0; k + 1 < curve_plastic_.size(); ++k) {
    per_width_.push_back(1 / (curve_plastic_[k + 1] - curve_plastic_[k]));
  }
  for (const MonotoneCubic& curve : curves) end_pressure_.push_back(curve.x().back());
  least_pressure_ = -1e-3 / curves.front().at(0).slope;

  // The first node lies at or below pressure zero, where a curve is straight.
  for (std::size_t node = 0; node <= nodes_.size(); ++node) {
    for (const MonotoneCubic& curve : curves) modulus_.push_back(1 / curve.at(nodes_.start(node)).slope);
  }
}

}  // namespace tamp::components
