#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "components/materials/cap_vertex.hpp"
#include "components/materials/return_point.hpp"

namespace tamp::components::cap_return
{

/// The return as one bracketed equation: slower than Newton's method, and it cannot diverge.
template <class Path>
class Bracketed
{
 public:
  /// `n_evaluations` of the path are counted on.
  Bracketed(const YieldSurface& surface, const Path& path, int& n_evaluations)
      : surface_(surface), path_(path), n_evaluations_(n_evaluations)
  {
  }

  /// Pressure above the vertex, h rising with pressure there: the return dilates, d < 0.
  ReturnPoint dilating(const Residual& trial)
  {
    // The root of phi linearised at the trial, the cap held.
    const double slope = trial.normal.slope_sine / std::max(trial.normal.sine, 1e-3);
    const double excess = std::max(trial.at.trial_sqrt_j2 - trial.limit, 0.0);
    double low_d =
        -excess * slope / (trial.at.shear_modulus - slope * slope * trial.at.pressure_slope) - strain_tolerance;
    Residual low = residual(low_d), high = trial;
    while (low.value > 0 && n_evaluations_ < max_evaluations) {
      high = low;
      low_d *= 2;
      low = residual(low_d);
    }
    return between(low, high, 0);
  }

  /// On the falling side of the cap or beyond its end: the return compacts, d > 0.
  ReturnPoint compacting(const Residual& trial)
  {
    // Near the apex phi sin(theta) goes as the root of the distance from it, so solve in u = sqrt(d - d_apex).
    const PathPoint& at = trial.at;
    Residual low = trial;
    double apex = (at.pressure - at.crush_pressure) / (at.crush_slope - at.pressure_slope);
    if (at.pressure > at.crush_pressure) {
      const RootOf<double> root = falling_root(
          path_, at, true, [](const PathPoint& p) { return p.pressure - p.crush_pressure; },
          [](const PathPoint& p) { return p.pressure_slope - p.crush_slope; });
      n_evaluations_ += static_cast<int>(root.n_evaluations);
      apex = root.d;
      low = residual(apex);
      const double excess = low.at.pressure - low.at.crush_pressure;
      if (!(low.at.trial_sqrt_j2 > no_shear * low.at.crush_pressure)) {
        // All the deviator goes.
        const double multiplier = low.at.trial_sqrt_j2 / low.at.shear_modulus, left = excess / -low.at.pressure_slope;
        return {ReturnStatus::apex, apex, low.at, 0, multiplier, low.normal, left, n_evaluations_};
      }
      // Round-off may have put the apex just inside: with so little shear that is the answer.
      if (low.value >= 0) return surface_point(low, n_evaluations_);
    }
    const double half_axis = surface_.cap(at.pressure, at.crush_pressure).half_axis;
    double high_d = apex + half_axis / (at.crush_slope - at.pressure_slope);
    Residual high = residual(high_d);
    while (high.value < 0 && n_evaluations_ < max_evaluations) {
      low = high;
      high_d = apex + 2 * (high_d - apex);
      high = residual(high_d);
    }
    return between(low, high, apex);
  }

  /// Pressure below the vertex: the vertex if the trial lies in its normal cone, otherwise dilation on the cone.
  ReturnPoint from_tension(const Residual& trial)
  {
    const VertexReturnOf<double> vertex = return_to_vertex(surface_, path_, trial.at, true);
    n_evaluations_ += static_cast<int>(vertex.n_evaluations);
    const double d = vertex.end.d, at_vertex = vertex.value;
    if (at_vertex <= 0) {
      ReturnPoint point = vertex.point(surface_);
      point.n_evaluations = n_evaluations_;
      return point;
    }
    Residual high = vertex.end;
    high.value = at_vertex;
    double step = at_vertex;
    Residual low = residual(d - step);
    while (low.value > 0 && n_evaluations_ < max_evaluations) {
      high = low;
      step *= 2;
      low = residual(d - step);
    }
    return between(low, high, 0);
  }

 private:
  Residual residual(double d)
  {
    ++n_evaluations_;
    return evaluate(surface_, d, path_(d));
  }

  ReturnPoint failed(const Residual& r) const
  {
    return {ReturnStatus::failed, r.d, r.at, r.at.trial_sqrt_j2, 0, r.normal, r.value, n_evaluations_};
  }

  /// Chandrupatla's method (1997) in u = sqrt(d - origin) where the bracket lies above `origin`, else in d itself.
  ReturnPoint between(Residual a, Residual b, double origin)
  {
    if (!(a.value <= 0 && b.value >= 0)) return failed(b);
    const bool rooted = origin <= a.d && b.d > 0 && a.d >= 0;
    const auto to_u = [&](double d) { return rooted ? std::sqrt(std::max(d - origin, 0.0)) : d; };
    const auto to_d = [&](double u) { return rooted ? origin + u * u : u; };

    // b is the newest end, a the one across from it, c the one before.
    double ua = to_u(a.d), ub = to_u(b.d), uc = ua;
    Residual c = a;
    double t = a.value / (a.value - b.value);
    t = std::clamp(t, 0.02, 0.98);
    while (true) {
      const Residual& best = std::abs(a.value) < std::abs(b.value) ? a : b;
      const double width = std::abs(a.d - b.d);
      if (std::abs(best.value) <= flow_tolerance * std::abs(best.d) + 0.1 * strain_tolerance * best.normal.sine ||
          (width <= strain_tolerance + 4e-16 * std::abs(b.d) &&
           (std::abs(a.normal.sine - b.normal.sine) <= 1e-9 || are_one_place(a.at, b.at)))) {
        return surface_point(best, n_evaluations_);
      }
      if (n_evaluations_ >= max_evaluations) return failed(best);
      if (const std::optional<Residual> kink = n_evaluations_ > 8 ? kink_between(a, b) : std::nullopt) {
        if (kink->value == 0) return surface_point(*kink, n_evaluations_);
      }

      const double u = ua + t * (ub - ua);
      const Residual next = residual(to_d(u));
      if (std::signbit(next.value) == std::signbit(a.value)) {
        c = a;
        uc = ua;
      } else {
        c = b;
        uc = ub;
        b = a;
        ub = ua;
      }
      a = next;
      ua = u;
      t = next_fraction(a, b, c, ua, ub, uc);
      const double least = 0.5 * strain_tolerance / std::max(std::abs(a.d - b.d), strain_tolerance);
      t = std::clamp(t, std::min(least, 0.5), 1 - std::min(least, 0.5));
    }
  }

  /// But for round-off of pressure and crush pressure. By the apex the sine goes as the root of their difference: there
  /// it may differ when they do not, and no bracket gets closer.
  static bool are_one_place(const PathPoint& a, const PathPoint& b)
  {
    constexpr double round_off = 2e-15;
    return std::abs(a.pressure - b.pressure) <= round_off * a.crush_pressure &&
           std::abs(a.crush_pressure - b.crush_pressure) <= round_off * a.crush_pressure;
  }

  /// Inverse quadratic interpolation where it is trustworthy (Chandrupatla's criterion), the middle otherwise.
  static double next_fraction(const Residual& a, const Residual& b, const Residual& c, double ua, double ub, double uc)
  {
    const double xi = (ua - ub) / (uc - ub);
    const double phi = (a.value - b.value) / (c.value - b.value);
    if (!(phi * phi < xi && (1 - phi) * (1 - phi) < 1 - xi)) return 0.5;
    const double alpha = (uc - ua) / (ub - ua);
    return a.value / (b.value - a.value) * c.value / (b.value - c.value) +
           alpha * a.value / (c.value - a.value) * b.value / (c.value - b.value);
  }

  /// If one kink of the envelope lies between the ends and its normal cone holds the trial: the point there, value 0.
  std::optional<Residual> kink_between(const Residual& a, const Residual& b)
  {
    if (std::min(a.at.pressure, b.at.pressure) < surface_.vertex_pressure()) return std::nullopt;
    const std::size_t of_a = surface_.hull().segment_of(a.at.pressure),
                      of_b = surface_.hull().segment_of(b.at.pressure);
    const std::size_t right = std::max(of_a, of_b);
    if (right != std::min(of_a, of_b) + 1) return std::nullopt;
    const double knot = surface_.hull().x()[right];
    double d = a.d + (knot - a.at.pressure) / (b.at.pressure - a.at.pressure) * (b.d - a.d);
    PathPoint at = path_(d);
    for (int i = 0; i < 3; ++i) {
      d += (knot - at.pressure) / at.pressure_slope;
      at = path_(d);
    }
    n_evaluations_ += 4;
    if (std::abs(knot - at.pressure) > 1e-12 * std::abs(at.pressure) + 1e-9 * std::abs(surface_.vertex_pressure())) {
      return std::nullopt;
    }
    Residual r = evaluate(surface_, d, at);
    const double g = surface_.hull().y()[right];
    const YieldSurface::Cap cap = surface_.cap(at.pressure, at.crush_pressure);
    const auto with_slope = [&](std::size_t segment) {
      const double slope = surface_.hull().slope_of_segment(segment);
      return residual_value(d, at, g * cap.sine, {cap_slope_sine(g, slope, cap), cap.sine});
    };
    if (with_slope(right) > 0 || with_slope(right - 1) < 0) return std::nullopt;
    r.limit = g * cap.sine;
    r.value = 0;
    return r;
  }

  const YieldSurface& surface_;
  const Path& path_;
  int& n_evaluations_;
};

}  // namespace tamp::components::cap_return
