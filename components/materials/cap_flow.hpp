#pragma once

#include <algorithm>
#include <cmath>

#include "components/materials/invariants.hpp"
#include "components/materials/return_point.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Where a step of the sand starts to flow, along what normal and how much, and what error a step makes whose flow is
/// taken along the normals of its two ends. Pressures and volumetric strains compression positive.

/// Trial sqrt(J2) of s + 2 G e from the three products of s and e: they are all that a path needs of the tensors.
struct DeviatoricTrial {
  double old_j2, mixed, increment_j2;

  double sqrt_j2(double shear_modulus) const
  {
    return std::sqrt(std::max(old_j2 + 2 * shear_modulus * (mixed + 2 * shear_modulus * increment_j2), 0.0));
  }
};

template <int Size>
DeviatoricTrial deviatoric_trial(const Eigen::Matrix<double, Size, 1>& s, const Eigen::Matrix<double, Size, 1>& e)
{
  return {j2_of(s), double_dot(s, e), j2_of(e)};
}

/// Where the elastic path from the old state to the trial meets the old surface, and half of the flow from there on, at
/// the rate it starts with.
struct FlowStart {
  double fraction = 0;  ///< of the step, elastic
  double pressure = 0;  ///< there
  double sqrt_j2 = 0;   ///< there
  SurfaceNormal normal{};
  double multiplier = 0;          ///< half the flow: dl; zero where it does not load
  double plastic_volumetric = 0;  ///< half the flow: d
  ReturnGuess guess{};            ///< of the other half
};

/// The fraction of the way from the old state to a trial outside at which the surface is met, by a few steps of false
/// position (the Illinois variant); 0 where the old state is on it.
inline double fraction_inside(const YieldSurface& surface, double pressure, double crush_pressure,
                              const DeviatoricTrial& deviatoric, const PathPoint& trial)
{
  const auto excess = [&](double fraction) {
    const double p = pressure + fraction * (trial.pressure - pressure);
    const double q = deviatoric.sqrt_j2(fraction * trial.shear_modulus);
    const double beyond = std::max(p - crush_pressure, surface.vertex_pressure() - p);
    return std::max(q - surface.limit(p, crush_pressure), beyond);
  };
  double low = 0, below = std::sqrt(deviatoric.old_j2) - surface.limit(pressure, crush_pressure);
  if (below > -1e-6 * crush_pressure) return 0;
  double high = 1, above = excess(1);
  const double enough = 1e-3 * (above - below);
  for (int i = 0; i < 8; ++i) {
    const double middle = low + (high - low) * below / (below - above), value = excess(middle);
    if (std::abs(value) <= enough) return middle;
    if (value > 0) {
      high = middle;
      above = value;
      below *= 0.5;
    } else {
      low = middle;
      below = value;
      above *= 0.5;
    }
  }
  return low;
}

/// With the consistency condition of the continuum, G s:e/q - G dl - h_p (dp - d dp/dd) - h_X X' d = 0, where dp is
/// the trial's change of pressure and d = -dl h_p.
inline FlowStart flow_start(const YieldSurface& surface, double pressure, double crush_pressure,
                            const DeviatoricTrial& deviatoric, const PathPoint& trial)
{
  const double fraction = fraction_inside(surface, pressure, crush_pressure, deviatoric, trial);
  const double p = pressure + fraction * (trial.pressure - pressure), shear = trial.shear_modulus;
  const YieldSurface::Strength g = surface.strength(p);
  const YieldSurface::Cap cap = surface.cap(p, crush_pressure);
  const SurfaceNormal normal{cap_slope_sine(g.value, g.slope, cap), cap.sine};
  FlowStart start{fraction, p, deviatoric.sqrt_j2(fraction * shear), normal};
  // A deviator of nothing but round-off has no direction.
  const bool sheared = start.sqrt_j2 > cap_return::no_shear * crush_pressure;
  if (!(g.segment && sheared && cap.sine > 0)) return start;
  if (const auto slopes = surface.slopes_at_kink(p)) {
    // Which of the two normals counts would be for round-off to say.
    start.normal.slope_sine = cap_slope_sine(g.value, 0.5 * (slopes->first + slopes->second), cap);
    return start;
  }

  const double r = surface.cap_ellipticity(), slope = normal.slope_sine, sine = normal.sine;
  const double turned = deviatoric.mixed + 4 * fraction * shear * deviatoric.increment_j2;  // s:e there
  const double loading = shear * sine * turned / start.sqrt_j2 - slope * (trial.pressure - pressure);
  const double by_crush = g.value * cap.rho * (r + cap.rho * (1 - r)) / cap.half_axis;  // h_X sin
  const double elastic = shear * sine * sine - trial.pressure_slope * slope * slope;
  const double stiffness = elastic - by_crush * trial.crush_slope * slope;
  if (!(loading > 0 && stiffness > 0.1 * elastic)) return start;

  const double half = 0.5 * (1 - fraction) * loading / stiffness;  // of dl / sin
  const double d = -half * slope;
  start.multiplier = half * sine;
  start.plastic_volumetric = d;
  const double end_sine =
      surface.cap(trial.pressure + 2 * d * trial.pressure_slope, trial.crush_pressure + 2 * d * trial.crush_slope).sine;
  start.guess = {d, std::max(end_sine, 0.3 * sine)};
  return start;
}

/// Estimated error of the stress, Pa, of a step whose flow was `start`'s half and then `point`'s return; `cosine` is
/// that between the stress deviators of the two. With the turn of the normal from one to the other: half of it for the
/// flow that one has more than the other (all of it, for a return alone), and for the rest what the trapezoidal rule
/// leaves of a turn.
inline double flow_error(const FlowStart& start, const ReturnPoint& point, double cosine)
{
  const double bulk = point.at.bulk_modulus, shear = point.at.shear_modulus;
  // Lengths are in the norm of the elastic energy.
  const auto length = [&](double volumetric, double deviatoric) {
    return std::sqrt(bulk * volumetric * volumetric + shear * deviatoric * deviatoric);
  };
  const SurfaceNormal& a = start.normal;
  // That of the flow itself, which on a kink of the envelope is neither side's.
  SurfaceNormal b = point.normal;
  if (point.multiplier > 0) b.slope_sine = -point.plastic_volumetric / point.multiplier * b.sine;
  const double product = bulk * a.slope_sine * b.slope_sine + shear * a.sine * b.sine * cosine;
  const double lengths = length(a.slope_sine, a.sine) * length(b.slope_sine, b.sine);
  const double turn = std::sqrt(std::max(2 - 2 * product / lengths, 0.0));

  const double first = length(start.plastic_volumetric, start.multiplier);
  const double second = length(point.plastic_volumetric, point.multiplier);
  const double returned = bulk * std::abs(start.plastic_volumetric + point.plastic_volumetric) +
                          shear * (start.multiplier + point.multiplier);
  const double uneven = std::abs(first - second) / std::max(first + second, 1e-300);
  constexpr double of_turn_squared = 0.25;
  return returned * turn * (0.5 * uneven + of_turn_squared * turn);
}

}  // namespace tamp::components
