#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>
#include <tuple>
#include <utility>

#include "components/materials/yield_surface.hpp"

namespace tamp::components
{

/// Input and output of the return mapping of the sand (cap_return.hpp). Pressures, the cap and
/// volumetric strains are compression positive.

/// The state after a plastic volumetric strain d.
template <class Number>
struct PathPointOf {
  Number pressure;
  Number pressure_slope;  ///< dp/dd, negative
  Number crush_pressure;
  Number crush_slope;  ///< dX/dd, not negative
  Number bulk_modulus;
  Number shear_modulus;
  Number trial_sqrt_j2;

  static constexpr auto fields = std::tuple(
      &PathPointOf::pressure, &PathPointOf::pressure_slope, &PathPointOf::crush_pressure, &PathPointOf::crush_slope,
      &PathPointOf::bulk_modulus, &PathPointOf::shear_modulus, &PathPointOf::trial_sqrt_j2);
};
using PathPoint = PathPointOf<double>;

/// The outward normal of the surface, (-h_p, 1) in pressure and sqrt(J2), times the cap's sine: that stays bounded at
/// the apex, where h_p -> -infinity.
template <class Number>
struct SurfaceNormalOf {
  Number slope_sine;  ///< h_p sin(theta)
  Number sine;        ///< Fc

  static constexpr auto fields = std::tuple(&SurfaceNormalOf::slope_sine, &SurfaceNormalOf::sine);
};
using SurfaceNormal = SurfaceNormalOf<double>;

/// The part of the surface that a return ends on. At `end_of_dilation` the volume is prescribed, and does not follow
/// from the normal.
enum class ReturnStatus { elastic, cone_or_cap, apex, tension_vertex, end_of_dilation, failed };

template <class Number>
struct ReturnPointOf {
  ReturnStatus status;
  Number plastic_volumetric;  ///< d, compression positive
  PathPointOf<Number> at;     ///< the path there
  Number sqrt_j2;
  Number multiplier;               ///< dl, not negative
  SurfaceNormalOf<Number> normal;  ///< there
  Number residual;                 ///< of the equation solved, a strain
  int n_evaluations;               ///< number of evaluations of the path
};
using ReturnPoint = ReturnPointOf<double>;

/// A first guess of the return, where the caller has one.
template <class Number>
struct ReturnGuessOf {
  Number plastic_volumetric;
  Number sine;  ///< sine of the cap's angle, positive; 1 on the cone
};
using ReturnGuess = ReturnGuessOf<double>;

/// Whether a trial needs no return.
template <class Number>
Mask<Number> inside(const YieldSurface& surface, const PathPointOf<Number>& trial)
{
  return trial.pressure >= surface.vertex_pressure() && trial.pressure <= trial.crush_pressure &&
         trial.trial_sqrt_j2 <= surface.limit(trial.pressure, trial.crush_pressure);
}

namespace cap_return
{

inline constexpr double strain_tolerance = 1e-13;
inline constexpr double flow_tolerance = 1e-11;   // of the flow direction
inline constexpr double newton_tolerance = 1e-6;  // its steps shrink as their squares
inline constexpr double no_shear = 1e-12;         // sqrt(J2) over the crush pressure
inline constexpr int max_newton = 10;
inline constexpr int max_evaluations = 200;

/// phi(d) sin(theta), with h and its slope at one point. With f < 0 (inside the surface) there is no flow: phi = d.
template <class Number>
struct ResidualOf {
  Number d;
  PathPointOf<Number> at;
  Number limit;           // h
  Number envelope_slope;  // dg/dp
  SurfaceNormalOf<Number> normal;
  Number value;

  static constexpr auto fields = std::tuple(&ResidualOf::d, &ResidualOf::at, &ResidualOf::limit,
                                            &ResidualOf::envelope_slope, &ResidualOf::normal, &ResidualOf::value);
};
using Residual = ResidualOf<double>;

template <class Number>
Number residual_value(const Number& d, const PathPointOf<Number>& at, const Number& limit,
                      const SurfaceNormalOf<Number>& normal)
{
  return d * normal.sine + greater_of<Number>(at.trial_sqrt_j2 - limit, 0.0) / at.shear_modulus * normal.slope_sine;
}

template <class Number>
ResidualOf<Number> evaluate(const YieldSurface& surface, const Number& d, const PathPointOf<Number>& at)
{
  const auto g = surface.strength(at.pressure);
  const YieldSurface::CapOf<Number> cap = surface.cap(at.pressure, at.crush_pressure);
  const Number limit = g.value * cap.sine;
  const SurfaceNormalOf<Number> normal{cap_slope_sine(g.value, g.slope, cap), cap.sine};
  return {d, at, limit, g.slope, normal, residual_value(d, at, limit, normal)};
}

template <class Number>
ReturnPointOf<Number> surface_point(const ResidualOf<Number>& r, int n_evaluations)
{
  const Number q = lesser_of(r.limit, r.at.trial_sqrt_j2);
  const Number multiplier = (r.at.trial_sqrt_j2 - q) / r.at.shear_modulus;
  return {ReturnStatus::cone_or_cap, r.d, r.at, q, multiplier, r.normal, r.value, n_evaluations};
}

/// The surface after a plastic volumetric strain d that the normal has not chosen: all of the rest is a return of the
/// deviator along itself.
template <class Number>
ReturnPointOf<Number> end_of_dilation(const YieldSurface& surface, const Number& d, const PathPointOf<Number>& at)
{
  ReturnPointOf<Number> point = surface_point(evaluate(surface, d, at), 1);
  point.status = ReturnStatus::end_of_dilation;
  return point;
}

}  // namespace cap_return

}  // namespace tamp::components
