#pragma once

#include <cmath>
#include <limits>

#include "components/materials/return_point.hpp"

namespace tamp::components::cap_return
{

/// d at which a falling, smooth function of the path is zero.
template <class Number>
struct RootOf {
  Number d;
  Number n_evaluations;  ///< of the path
};

/// Newton kept inside a bracket, for the particles that are `searched`, each until it has converged. `start` is
/// path(0).
template <class Number, class Path, class Value, class Slope>
RootOf<Number> falling_root(const Path& path, const PathPointOf<Number>& start, Mask<Number> searched,
                            const Value& value, const Slope& slope)
{
  constexpr double infinity = std::numeric_limits<double>::infinity();
  PathPointOf<Number> at = start;
  RootOf<Number> root{0.0, 0.0};
  Number low = -infinity, high = infinity;
  for (int i = 0; i < 60 && any(searched); ++i) {
    const Number d = root.d, v = value(at);
    low = select(v > 0.0, d, low);
    high = select(v > 0.0, high, d);
    const Number newton = d - v / slope(at);
    const Number next = select(newton >= low && newton <= high, newton, Number(0.5 * (low + high)));
    const Mask<Number> settled = abs(Number(next - d)) <= 0.01 * strain_tolerance + 1e-15 * abs(d);
    root.d = select(searched, next, d);
    searched = searched && !settled;
    root.n_evaluations = root.n_evaluations + select(searched, Number(1.0), Number(0.0));
    if (any(searched)) at = path(root.d);
  }
  return root;
}

/// The return to the tension vertex, which takes all of the deviator.
template <class Number>
struct VertexReturnOf {
  ResidualOf<Number> end;
  /// phi at the vertex, with its slope: not positive where the trial lies in the vertex's normal cone.
  Number value;
  Number n_evaluations;  ///< of the path

  ReturnPointOf<Number> point(const YieldSurface& surface) const
  {
    return {ReturnStatus::tension_vertex,
            end.d,
            end.at,
            0.0,
            end.at.trial_sqrt_j2 / end.at.shear_modulus,
            end.normal,
            (end.at.pressure - surface.vertex_pressure()) / -end.at.pressure_slope,
            0};
  }
};

/// Returns a trial in tension beyond the vertex to it.
template <class Number, class Path>
VertexReturnOf<Number> return_to_vertex(const YieldSurface& surface, const Path& path, const PathPointOf<Number>& trial,
                                        const Mask<Number>& searched)
{
  const RootOf<Number> root = falling_root(
      path, trial, searched,
      [&](const PathPointOf<Number>& at) { return Number(at.pressure - surface.vertex_pressure()); },
      [](const PathPointOf<Number>& at) { return at.pressure_slope; });
  const ResidualOf<Number> end = evaluate<Number>(surface, root.d, path(root.d));
  return {end, root.d + end.at.trial_sqrt_j2 / end.at.shear_modulus * surface.vertex_slope(), root.n_evaluations + 1.0};
}

}  // namespace tamp::components::cap_return
