#pragma once

#include <algorithm>
#include <cmath>

#include "components/materials/cap_path.hpp"
#include "components/materials/return_point.hpp"

namespace tamp::components
{

/// Where a step of the sand starts to flow, along what normal and how much, and what error a step makes whose flow is
/// taken along the normals of its two ends. Pressures and volumetric strains compression positive.

/// Where the elastic path from the old state to the trial meets the old surface, and half of the flow from there on, at
/// the rate it starts with.
template <class Number>
struct FlowStartOf {
  Number fraction = 0;  ///< elastic part of the step
  Number pressure = 0;  ///< where the flow starts
  Number sqrt_j2 = 0;   ///< where the flow starts
  SurfaceNormalOf<Number> normal{};
  Number multiplier = 0;          ///< half the flow: dl; zero where it does not load
  Number plastic_volumetric = 0;  ///< half the flow: d
  ReturnGuessOf<Number> guess{};  ///< guess of the other half of the flow
  /// Whether it is on a kink of the envelope, where round-off decides which of two normals counts.
  Mask<Number> on_kink = Mask<Number>(false);

  /// The stress deviator where the flow starts.
  CombinationOf<Number> along(const Number& shear_modulus) const { return {1.0, 2.0 * shear_modulus * fraction}; }
  /// Strain deviator that is left after half the flow.
  CombinationOf<Number> left(const CombinationOf<Number>& direction) const
  {
    const Number half = 0.5 * multiplier / sqrt_j2;
    return {-half, 1.0 - half * direction.of_strain};
  }
};
using FlowStart = FlowStartOf<double>;

/// The fraction of the way from an old state inside to a trial outside at which the surface is met, by a few steps of
/// false position (the Illinois variant); 0 where the old state is on it. `below` is how far that is from the surface
/// in sqrt(J2), negative inside.
template <class Number>
Number fraction_inside(const YieldSurface& surface, const CapParticleOf<Number>& old,
                       const DeviatoricTrialOf<Number>& deviatoric, const PathPointOf<Number>& trial, Number below)
{
  const Number crush = trial.crush_pressure;
  const auto excess = [&](const Number& fraction) {
    const Number p = old.pressure + fraction * (trial.pressure - old.pressure);
    const Number q = deviatoric.sqrt_j2(fraction * trial.shear_modulus);
    const Number beyond = greater_of<Number>(p - crush, surface.vertex_pressure() - p);
    return greater_of<Number>(q - surface.limit(p, crush), beyond);
  };
  Mask<Number> searched = !(below > -1e-6 * crush);
  Number met = 0.0;
  if (!any(searched)) return met;
  Number low = 0.0, high = 1.0, above = excess(high);
  searched = searched && above > 0.0;  // others beside them do not flow
  const Number enough = 1e-3 * (above - below);
  for (int i = 0; i < 8 && any(searched); ++i) {
    const Number middle = low + (high - low) * below / (below - above), value = excess(middle);
    const Mask<Number> found = searched && abs(value) <= enough, too_far = value > 0.0;
    met = select(found, middle, met);
    searched = searched && !found;
    high = select(too_far, middle, high);
    low = select(too_far, low, middle);
    above = select(too_far, value, 0.5 * above);
    below = select(too_far, 0.5 * below, value);
  }
  return select(searched, low, met);
}

/// The start of the flow, from the consistency condition of the continuum, G s:e/q - G dl - h_p (dp - d dp/dd) - h_X X'
/// d = 0, where dp is the trial's change of pressure and d = -dl h_p.
template <class Number>
FlowStartOf<Number> flow_start(const YieldSurface& surface, const CapParticleOf<Number>& old,
                               const DeviatoricTrialOf<Number>& deviatoric, const PathPointOf<Number>& trial)
{
  const Number crush_pressure = trial.crush_pressure, rise = trial.pressure - old.pressure;
  const Number shear = trial.shear_modulus;
  Number p = old.pressure;
  auto g = surface.strength(p);
  YieldSurface::CapOf<Number> cap = surface.cap(p, crush_pressure);
  const Number excess = sqrt(old.j2) - g.value * cap.sine;
  const Number fraction = fraction_inside(surface, old, deviatoric, trial, excess);
  if (any(fraction > 0.0)) {
    p = old.pressure + fraction * rise;
    g = surface.strength(p);
    cap = surface.cap(p, crush_pressure);
  }
  const SurfaceNormalOf<Number> normal{cap_slope_sine(g.value, g.slope, cap), cap.sine};
  FlowStartOf<Number> start{fraction, p, deviatoric.sqrt_j2(fraction * shear), normal};

  const double r = surface.cap_ellipticity();
  const Number slope = normal.slope_sine, sine = normal.sine;
  const Number turned = deviatoric.mixed + 4.0 * fraction * shear * deviatoric.increment_j2;  // s:e there
  const Number loading = shear * sine * turned / start.sqrt_j2 - slope * rise;
  const Number by_crush = g.value * cap.rho * (r + cap.rho * (1.0 - r)) / cap.half_axis;  // h_X sin
  const Number elastic = shear * sine * sine - trial.pressure_slope * slope * slope;
  const Number stiffness = elastic - by_crush * trial.crush_slope * slope;

  // A deviator of nothing but round-off has no direction.
  const Mask<Number> has_normal =
      p >= surface.vertex_pressure() && start.sqrt_j2 > cap_return::no_shear * crush_pressure && cap.sine > 0.0;
  start.on_kink = has_normal && surface.is_kink(p, g);
  const Mask<Number> flows = has_normal && !start.on_kink && loading > 0.0 && stiffness > 0.1 * elastic;
  const Number half = 0.5 * (1.0 - fraction) * loading / stiffness;  // of dl / sin
  const Number d = -half * slope, zero = 0.0;
  start.multiplier = select(flows, half * sine, zero);
  start.plastic_volumetric = select(flows, d, zero);
  const Number end_pressure = trial.pressure + 2.0 * d * trial.pressure_slope;
  const Number end_crush = trial.crush_pressure + 2.0 * d * trial.crush_slope;
  start.guess = {d, greater_of<Number>(surface.cap(end_pressure, end_crush).sine, 0.3 * sine)};
  return start;
}

/// The mean of the two normals of a kink.
inline SurfaceNormal normal_of_kink(const YieldSurface& surface, double pressure, double crush_pressure)
{
  const YieldSurface::Cap cap = surface.cap(pressure, crush_pressure);
  const auto [left, right] = surface.hull().slopes_beside_kink(pressure);
  return {cap_slope_sine(surface.strength(pressure).value, 0.5 * (left + right), cap), cap.sine};
}

/// Estimated error of the stress, Pa, of a step whose flow was `start`'s half and then `point`'s return; `cosine` is
/// that between the stress deviators of the two. With the turn of the normal from one to the other: half of it for the
/// flow that one has more than the other (all of it, for a return alone), and for the rest what the trapezoidal rule
/// leaves of a turn.
template <class Number>
Number flow_error(const FlowStartOf<Number>& start, const ReturnPointOf<Number>& point, const Number& cosine)
{
  const Number bulk = point.at.bulk_modulus, shear = point.at.shear_modulus;
  // Lengths are in the norm of the elastic energy.
  const auto length = [&](const Number& volumetric, const Number& deviatoric) {
    return sqrt(bulk * volumetric * volumetric + shear * deviatoric * deviatoric);
  };
  const SurfaceNormalOf<Number>& a = start.normal;
  // The normal of the flow itself, which on a kink of the envelope is neither side's; not at the apex, where the flow
  // has none.
  SurfaceNormalOf<Number> b = point.normal;
  b.slope_sine = select(point.multiplier > 0.0 && b.sine > 0.0, -point.plastic_volumetric / point.multiplier * b.sine,
                        point.normal.slope_sine);
  const Number product = bulk * a.slope_sine * b.slope_sine + shear * a.sine * b.sine * cosine;
  const Number lengths = length(a.slope_sine, a.sine) * length(b.slope_sine, b.sine);
  const Number turn = sqrt(greater_of<Number>(2.0 - 2.0 * product / lengths, 0.0));

  const Number first = length(start.plastic_volumetric, start.multiplier);
  const Number second = length(point.plastic_volumetric, point.multiplier);
  const Number returned =
      bulk * abs(start.plastic_volumetric + point.plastic_volumetric) + shear * (start.multiplier + point.multiplier);
  const Number uneven = abs(first - second) / greater_of<Number>(first + second, 1e-300);
  constexpr double of_turn_squared = 0.25;
  return returned * turn * (0.5 * uneven + of_turn_squared * turn);
}

/// The same error for a step whose volume is given, and whose deviator returns along itself.
template <class Number>
Number shear_error(const ReturnPointOf<Number>& point, const Number& cosine)
{
  const Number turn = sqrt(greater_of<Number>(2.0 - 2.0 * cosine, 0.0));
  return 0.5 * point.at.shear_modulus * point.multiplier * turn;
}

}  // namespace tamp::components
