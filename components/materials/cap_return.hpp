#pragma once

#include <optional>

#include "components/materials/cap_bracket.hpp"
#include "components/materials/cap_newton.hpp"
#include "components/materials/return_point.hpp"

namespace tamp::components
{

/// The return mapping of associated cap plasticity as one equation.
///
/// Let d be the plastic volumetric strain of the step (compression positive). A `Path` says where the step would be
/// after it: pressure p(d), crush pressure X(d), shear modulus G(d) and elastic trial sqrt(J2), qt(d). The flow rule
/// d(eps^p) = dl df/d(sigma), f = sqrt(J2) - h(p, X), gives sqrt(J2) = qt - G dl and d = -dl h_p, so that on the
/// surface
///
///     phi(d) = d + (qt - h)/G h_p = 0,   h = h(p(d), X(d)).
///
/// It is solved as phi times the cap's sine, which stays bounded at the apex where h_p -> -infinity. Whatever the path,
/// phi changes sign over a bracket that is found before its solution starts, so the solution cannot diverge; where the
/// tabulated envelope has a kink phi jumps, and the sign change over the jump is the normal cone of that kink. Newton's
/// method comes first and mostly suffices; the bracket is for the rest.
///
/// `path(d)` gives the PathPoint after a plastic volumetric strain d; it must be continuous, with pressure falling and
/// crush pressure not falling in d. `trial` is path(0). A trial inside the surface stays where it is.
template <class Path>
ReturnPoint return_to_surface(const YieldSurface& surface, const Path& path, const PathPoint& trial,
                              const std::optional<ReturnGuess>& guess = std::nullopt)
{
  using namespace cap_return;
  int n_evaluations = 1;
  Newton<Path> newton(surface, path, n_evaluations);
  const double vertex = surface.vertex_pressure();
  if (guess) {
    if (const std::optional<ReturnPoint> point = newton.from_guess(trial, *guess)) return *point;
  }

  const Residual start = evaluate(surface, 0.0, trial);
  const bool beyond = trial.pressure > trial.crush_pressure;
  if (trial.pressure >= vertex && !beyond && trial.trial_sqrt_j2 <= start.limit) {
    return {ReturnStatus::elastic, 0, trial, trial.trial_sqrt_j2, 0, start.normal, 0, n_evaluations};
  }
  Bracketed<Path> bracketed(surface, path, n_evaluations);
  if (trial.pressure < vertex) return bracketed.from_tension(start);
  if (!beyond || trial.trial_sqrt_j2 > no_shear * trial.crush_pressure) {
    const std::optional<ReturnPoint> point =
        start.normal.sine < 1 ? newton.on_cap(trial, newton.start_on_cap(trial)) : newton.on_cone(trial, 0);
    if (point) return *point;
  }
  if (beyond || start.normal.slope_sine < 0) return bracketed.compacting(start);
  return start.value == 0 ? surface_point(start, n_evaluations) : bracketed.dilating(start);
}

template <class Path>
ReturnPoint return_to_surface(const YieldSurface& surface, const Path& path)
{
  return return_to_surface(surface, path, path(0));
}

}  // namespace tamp::components
