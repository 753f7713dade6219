#pragma once

#include "components/curves/piecewise_linear.hpp"
#include "components/moduli/modulus.hpp"

namespace tamp::components
{

/// Smallest crush pressure of a sand in the state form, Pa. The hydrostat starts plastic, so that the consistent crush
/// curve starts from zero; a cap of zero size has no inside. What it costs: the hydrostat is not followed below this
/// pressure, that is, up to about 0.07 % of strain in the concrete sand.
inline constexpr double least_crush_pressure = 1e5;

/// The crush curve X(plastic volumetric strain) that agrees with a state form and a measured hydrostat H(total
/// volumetric strain): where p(e, plastic) = H(e + plastic). Monotone hydrostatic loading then follows H. Compression
/// positive. It runs to the plastic strain at which the hydrostat ends. Throws BadValue where the surface does not meet
/// the hydrostat or X would not rise.
PiecewiseLinear consistent_crush_curve(const Modulus& modulus, const PiecewiseLinear& hydrostat);

}  // namespace tamp::components
