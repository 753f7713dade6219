#pragma once

#include <algorithm>
#include <cstddef>
#include <optional>

#include "components/materials/yield_surface.hpp"

namespace tamp::components
{

/// What the return mapping of the sand (cap_return.hpp) is told of a step, and what it answers. Pressures, the cap and
/// volumetric strains are compression positive.

/// The state after a plastic volumetric strain d.
struct PathPoint {
  double pressure;
  double pressure_slope;  ///< dp/dd, negative
  double crush_pressure;
  double crush_slope;  ///< dX/dd, not negative
  double bulk_modulus;
  double shear_modulus;
  double trial_sqrt_j2;
};

/// The outward normal of the surface, (-h_p, 1) in pressure and sqrt(J2), times the cap's sine: that stays bounded at
/// the apex, where h_p -> -infinity.
struct SurfaceNormal {
  double slope_sine;  ///< h_p sin(theta)
  double sine;        ///< Fc
};

enum class ReturnStatus { elastic, cone_or_cap, apex, tension_vertex, failed };

struct ReturnPoint {
  ReturnStatus status;
  double plastic_volumetric;  ///< d, compression positive
  PathPoint at;               ///< the path there
  double sqrt_j2;
  double multiplier;     ///< dl, not negative
  SurfaceNormal normal;  ///< there
  double residual;       ///< what is left of the equation solved, a strain
  int n_evaluations;     ///< of the path
};

/// A first guess of the return, where the caller has one.
struct ReturnGuess {
  double plastic_volumetric;
  double sine;  ///< of the cap, positive; 1 on the cone
};

/// Whether a trial needs no return.
inline bool inside(const YieldSurface& surface, const PathPoint& trial)
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
struct Residual {
  double d;
  PathPoint at;
  double limit;  // h
  SurfaceNormal normal;
  std::optional<std::size_t> segment;
  double value;
};

inline double residual_value(double d, const PathPoint& at, double limit, const SurfaceNormal& normal)
{
  return d * normal.sine + std::max(at.trial_sqrt_j2 - limit, 0.0) / at.shear_modulus * normal.slope_sine;
}

inline Residual evaluate(const YieldSurface& surface, double d, const PathPoint& at)
{
  const YieldSurface::Strength g = surface.strength(at.pressure);
  const YieldSurface::Cap cap = surface.cap(at.pressure, at.crush_pressure);
  const double limit = g.value * cap.sine;
  const SurfaceNormal normal{cap_slope_sine(g.value, g.slope, cap), cap.sine};
  return {d, at, limit, normal, g.segment, residual_value(d, at, limit, normal)};
}

inline ReturnPoint surface_point(const Residual& r, int n_evaluations)
{
  const double q = std::min(r.limit, r.at.trial_sqrt_j2);
  const double multiplier = (r.at.trial_sqrt_j2 - q) / r.at.shear_modulus;
  return {ReturnStatus::cone_or_cap, r.d, r.at, q, multiplier, r.normal, r.value, n_evaluations};
}

}  // namespace cap_return

}  // namespace tamp::components
