#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "components/materials/yield_surface.hpp"

namespace tamp::components
{

/// The return mapping of associated cap plasticity as one bracketed equation.
///
/// Let d be the plastic volumetric strain of the step (compression positive). A `Path` says where the step would be
/// after it: pressure p(d), crush pressure X(d), shear modulus G(d) and elastic trial sqrt(J2), qt(d). The flow rule
/// d(eps^p) = dl df/d(sigma), f = sqrt(J2) - h(p, X), gives sqrt(J2) = qt - G dl and d = -dl h_p, so that on the
/// surface
///
///     phi(d) = d + (qt - h)/G h_p = 0,   h = h(p(d), X(d)).
///
/// It is solved as phi times the cap's sine, which stays bounded at the apex where h_p -> -infinity. Whatever the path,
/// phi changes sign over a bracket that is found before the solution starts, so the solution cannot diverge; where the
/// tabulated envelope has a kink phi jumps, and the sign change over the jump is the normal cone of that kink.

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

enum class ReturnStatus { elastic, cone_or_cap, apex, tension_vertex, failed };

struct ReturnPoint {
  ReturnStatus status;
  double plastic_volumetric;  ///< d, compression positive
  PathPoint at;               ///< the path there
  double sqrt_j2;
  double multiplier;  ///< dl, not negative
  double residual;    ///< what is left of the equation solved, a strain
  int n_evaluations;  ///< of the path
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
  double limit;       // h
  double slope_sine;  // h_p sin(theta)
  double sine;
  std::optional<std::size_t> segment;
  double value;
};

inline double residual_value(double d, const PathPoint& at, double limit, double slope_sine, double sine)
{
  return d * sine + std::max(at.trial_sqrt_j2 - limit, 0.0) / at.shear_modulus * slope_sine;
}

inline Residual evaluate(const YieldSurface& surface, double d, const PathPoint& at)
{
  const YieldSurface::Strength g = surface.strength(at.pressure);
  const YieldSurface::Cap cap = surface.cap(at.pressure, at.crush_pressure);
  const double limit = g.value * cap.sine;
  // h_p sin = g' sin^2 - g rho / (X - kappa): at the apex and beyond, its value at the apex.
  const double slope_sine = g.slope * cap.sine * cap.sine - g.value * std::min(cap.rho, 1.0) / cap.half_axis;
  return {d, at, limit, slope_sine, cap.sine, g.segment, residual_value(d, at, limit, slope_sine, cap.sine)};
}

template <class Path>
class Solver
{
 public:
  Solver(const YieldSurface& surface, const Path& path) : surface_(surface), path_(path) {}

  ReturnPoint solve(const PathPoint& at)
  {
    n_evaluations_ = 1;
    if (inside(surface_, at)) return {ReturnStatus::elastic, 0, at, at.trial_sqrt_j2, 0, 0, n_evaluations_};
    const Residual trial = evaluate(surface_, 0, at);
    if (at.pressure < surface_.vertex_pressure()) return from_tension(trial);
    if (at.pressure > at.crush_pressure || trial.slope_sine < 0) return compacting(trial);
    if (trial.value == 0) return surface_point(trial);
    return dilating(trial);
  }

 private:
  PathPoint path_at(double d)
  {
    ++n_evaluations_;
    return path_(d);
  }

  Residual residual(double d) { return evaluate(surface_, d, path_at(d)); }

  ReturnPoint surface_point(const Residual& r)
  {
    const double q = std::min(r.limit, r.at.trial_sqrt_j2);
    const double multiplier = (r.at.trial_sqrt_j2 - q) / r.at.shear_modulus;
    return {ReturnStatus::cone_or_cap, r.d, r.at, q, multiplier, r.value, n_evaluations_};
  }

  /// All the deviator goes: the apex on the hydrostat, or the tension vertex.
  ReturnPoint hydrostatic_point(ReturnStatus status, const PathPoint& at, double d, double excess)
  {
    return {status, d, at, 0, at.trial_sqrt_j2 / at.shear_modulus, excess / -at.pressure_slope, n_evaluations_};
  }

  /// Pressure above the vertex, h rising with pressure there: the return dilates, d < 0.
  ReturnPoint dilating(const Residual& trial)
  {
    double low_d = first_guess(trial);
    Residual low = residual(low_d);
    if (const std::optional<ReturnPoint> point = secant(trial, low)) return *point;

    Residual high = trial;
    while (low.value > 0 && n_evaluations_ < max_evaluations) {
      high = low;
      low_d *= 2;
      low = residual(low_d);
    }
    return bracketed(low, high, 0);
  }

  /// A few secant steps for d < 0, which settle where the envelope is straight. Nothing where they do not: the
  /// bracketed solution follows.
  std::optional<ReturnPoint> secant(Residual a, Residual b)
  {
    for (int i = 0; i < 4; ++i) {
      const double span = b.d - a.d, step = -b.value * span / (b.value - a.value);
      if (!(b.d + step < 0) || a.segment != b.segment) return std::nullopt;
      if (std::abs(step) <= strain_tolerance + newton_tolerance * std::abs(b.d)) {
        // What the next step would find, to the order of this one squared.
        PathPoint at = b.at;
        at.pressure += at.pressure_slope * step;
        at.crush_pressure += at.crush_slope * step;
        at.shear_modulus += (b.at.shear_modulus - a.at.shear_modulus) / span * step;
        at.trial_sqrt_j2 += (b.at.trial_sqrt_j2 - a.at.trial_sqrt_j2) / span * step;
        const Residual end = evaluate(surface_, b.d + step, at);
        if (!(at.trial_sqrt_j2 >= end.limit && end.slope_sine >= 0)) return std::nullopt;
        return surface_point(end);
      }
      a = b;
      b = residual(b.d + step);
    }
    return std::nullopt;
  }

  /// On the falling side of the cap or beyond its end: the return compacts, d > 0.
  ReturnPoint compacting(const Residual& trial)
  {
    if (const std::optional<ReturnPoint> point = newton_on_cap(trial)) return *point;

    // Near the apex phi sin(theta) goes as the root of the distance from it, so solve in u = sqrt(d - d_apex).
    const PathPoint& at = trial.at;
    Residual low = trial;
    double apex = (at.pressure - at.crush_pressure) / (at.crush_slope - at.pressure_slope);
    if (at.pressure > at.crush_pressure) {
      apex = where([](const PathPoint& p) { return p.pressure - p.crush_pressure; },
                   [](const PathPoint& p) { return p.pressure_slope - p.crush_slope; }, at);
      low = residual(apex);
      const double excess = low.at.pressure - low.at.crush_pressure;
      if (!(low.at.trial_sqrt_j2 > no_shear * low.at.crush_pressure)) {
        return hydrostatic_point(ReturnStatus::apex, low.at, apex, excess);
      }
      // Round-off may have put the apex just inside: with so little shear that is the answer.
      if (low.value >= 0) return surface_point(low);
    }
    const double half_axis = surface_.cap(at.pressure, at.crush_pressure).half_axis;
    double high_d = apex + half_axis / (at.crush_slope - at.pressure_slope);
    Residual high = residual(high_d);
    while (high.value < 0 && n_evaluations_ < max_evaluations) {
      low = high;
      high_d = apex + 2 * (high_d - apex);
      high = residual(high_d);
    }
    return bracketed(low, high, apex);
  }

  /// Newton's method for (d, t), t the tangent of half the cap's angle: sin = 2t/(1+t^2), cos = (1-t^2)/(1+t^2). Then
  /// the apex is no singular point. The equations are p(d) = kappa + a cos and phi sin = 0. Nothing where it strays or
  /// does not settle: the bracketed solution follows.
  std::optional<ReturnPoint> newton_on_cap(const Residual& trial)
  {
    const double r = surface_.cap_ellipticity(), vertex = surface_.vertex_pressure();
    PathPoint at = trial.at;
    double kappa = vertex + r * (at.crush_pressure - vertex), half_axis = at.crush_pressure - kappa;
    double d = 0, t = 0;
    if (at.pressure > at.crush_pressure) {
      if (!(at.trial_sqrt_j2 > no_shear * at.crush_pressure)) return std::nullopt;
      const double closing = at.crush_slope - at.pressure_slope;
      // From phi with h_p sin ~ -g/a: sin = qt g / (g^2 + a G d), d that of the apex and then of that point.
      const double apex = (at.pressure - at.crush_pressure) / closing, g = surface_.strength(at.crush_pressure).value;
      d = apex;
      for (int i = 0; i < 3; ++i) {
        const double sine = std::min(at.trial_sqrt_j2 * g / (g * g + half_axis * at.shear_modulus * d), 0.9);
        const double cosine = std::sqrt(1 - sine * sine);
        t = sine / (1 + cosine);
        d = apex + half_axis * (1 - cosine) / closing;
      }
      at = path_at(d);
    } else {
      const double cosine = std::min(trial.at.pressure - kappa, half_axis) / half_axis;
      t = std::sqrt((1 - cosine) / (1 + cosine));
    }

    PathPoint before = trial.at;
    double d_before = 0;
    for (int i = 0; i < max_newton; ++i) {
      kappa = vertex + r * (at.crush_pressure - vertex);
      half_axis = at.crush_pressure - kappa;
      const double unit = 1 / (1 + t * t), sine = 2 * t * unit, cosine = (1 - t * t) * unit;
      const double sine_t = 2 * cosine * unit, cosine_t = -2 * sine * unit;
      const YieldSurface::Strength g = surface_.strength(kappa + half_axis * cosine);
      const double g_t = g.slope * half_axis * cosine_t;
      const double pressure_d = (r + (1 - r) * cosine) * at.crush_slope, g_d = g.slope * pressure_d;
      // The path gives no derivatives of G and of the trial sqrt(J2): secants do.
      const double change = d == d_before ? 0 : 1 / (d - d_before);
      const double shear_d = (at.shear_modulus - before.shear_modulus) * change;
      const double trial_d = (at.trial_sqrt_j2 - before.trial_sqrt_j2) * change;

      const double compliance = 1 / at.shear_modulus, per_axis = 1 / half_axis;
      const double multiplier = (at.trial_sqrt_j2 - g.value * sine) * compliance;
      const double slope = g.slope * sine * sine - g.value * cosine * per_axis;  // h_p sin
      const double off_cap = at.pressure - kappa - half_axis * cosine;
      const double phi = d * sine + multiplier * slope;

      const double off_cap_d = at.pressure_slope - pressure_d, off_cap_t = -half_axis * cosine_t;
      const double multiplier_t = -(g_t * sine + g.value * sine_t) * compliance;
      const double multiplier_d = (trial_d - g_d * sine - multiplier * shear_d) * compliance;
      const double slope_t = 2 * g.slope * sine * sine_t - (g_t * cosine + g.value * cosine_t) * per_axis;
      const double slope_d = (g.value * (1 - r) * at.crush_slope * per_axis - g_d) * cosine * per_axis;
      const double phi_t = d * sine_t + multiplier_t * slope + multiplier * slope_t;
      const double phi_d = sine + multiplier_d * slope + multiplier * slope_d;

      const double per_off_cap = 1 / off_cap_d, ratio = phi_d * per_off_cap;
      double t_step = (ratio * off_cap - phi) / (phi_t - ratio * off_cap_t);
      t_step = std::clamp(t_step, -0.75 * t, 0.5 * (1 - t));
      const double d_step = -(off_cap + off_cap_t * t_step) * per_off_cap;
      if (std::abs(d_step) <= strain_tolerance + newton_tolerance * std::abs(d) &&
          std::abs(t_step) <= 10 * newton_tolerance * t) {
        // The next step would be of the order of this one squared, and so is what this straight one leaves out.
        at.pressure += at.pressure_slope * d_step;
        at.crush_pressure += at.crush_slope * d_step;
        at.shear_modulus += shear_d * d_step;
        at.trial_sqrt_j2 += trial_d * d_step;
        d += d_step;
        if (!(d > 0 && multiplier >= 0 && at.pressure <= at.crush_pressure)) return std::nullopt;
        return surface_point(evaluate(surface_, d, at));
      }
      before = at;
      d_before = d;
      d += d_step;
      t += t_step;
      if (!std::isfinite(d + t)) return std::nullopt;
      at = path_at(d);
    }
    return std::nullopt;
  }

  /// Pressure below the vertex: the vertex if the trial lies in its normal cone, otherwise dilation on the cone.
  ReturnPoint from_tension(const Residual& trial)
  {
    const double vertex = surface_.vertex_pressure();
    const double d = where([vertex](const PathPoint& p) { return p.pressure - vertex; },
                           [](const PathPoint& p) { return p.pressure_slope; }, trial.at);
    Residual high = residual(d);
    const double at_vertex = d + high.at.trial_sqrt_j2 / high.at.shear_modulus * surface_.vertex_slope();
    if (at_vertex <= 0) {
      return hydrostatic_point(ReturnStatus::tension_vertex, high.at, d, high.at.pressure - vertex);
    }
    high.value = at_vertex;
    double step = at_vertex;
    Residual low = residual(d - step);
    while (low.value > 0 && n_evaluations_ < max_evaluations) {
      high = low;
      step *= 2;
      low = residual(d - step);
    }
    return bracketed(low, high, 0);
  }

  /// The root of phi linearised at the trial.
  double first_guess(const Residual& trial)
  {
    const PathPoint& at = trial.at;
    const double sine = std::max(trial.sine, 1e-3);
    const double slope = trial.slope_sine / sine;
    const YieldSurface::Cap cap = surface_.cap(at.pressure, at.crush_pressure);
    const double r = surface_.cap_ellipticity();
    const double by_crush =
        trial.limit / (sine * sine) * std::min(cap.rho, 1.0) * (r + cap.rho * (1 - r)) / cap.half_axis;
    const double excess_slope = -slope * at.pressure_slope - by_crush * at.crush_slope;
    const double denominator = at.shear_modulus + std::max(slope * excess_slope, 0.0);
    const double excess = std::max(at.trial_sqrt_j2 - trial.limit, 0.0);
    const double guess = -excess * slope / denominator;
    return guess + std::copysign(strain_tolerance, guess);
  }

  /// d at which a falling, smooth function of the path is zero: Newton kept inside a bracket.
  template <class Value, class Slope>
  double where(Value value, Slope slope, const PathPoint& start)
  {
    PathPoint at = start;
    double d = 0, low = -std::numeric_limits<double>::infinity(), high = -low;
    for (int i = 0; i < 60; ++i) {
      const double v = value(at);
      (v > 0 ? low : high) = d;
      double next = d - v / slope(at);
      if (!(next >= low && next <= high)) next = 0.5 * (low + high);
      const bool settled = std::abs(next - d) <= 0.01 * strain_tolerance + 1e-15 * std::abs(d);
      d = next;
      if (settled) break;
      at = path_at(d);
    }
    return d;
  }

  /// Chandrupatla's method (1997) in u = sqrt(d - origin) where the bracket lies above `origin`, else in d itself.
  ReturnPoint bracketed(Residual a, Residual b, double origin)
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
      if (std::abs(best.value) <= flow_tolerance * std::abs(best.d) + 0.1 * strain_tolerance * best.sine ||
          (width <= strain_tolerance + 4e-16 * std::abs(b.d) && std::abs(a.sine - b.sine) <= 1e-9)) {
        return surface_point(best);
      }
      if (n_evaluations_ >= max_evaluations) return failed(best);
      if (const std::optional<Residual> kink = n_evaluations_ > 8 ? kink_between(a, b) : std::nullopt) {
        if (kink->value == 0) return surface_point(*kink);
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
    if (!a.segment || !b.segment || *a.segment == *b.segment) return std::nullopt;
    const std::size_t right = std::max(*a.segment, *b.segment);
    if (right - std::min(*a.segment, *b.segment) != 1) return std::nullopt;
    const double knot = surface_.hull().x()[right];
    double d = a.d + (knot - a.at.pressure) / (b.at.pressure - a.at.pressure) * (b.d - a.d);
    PathPoint at = path_at(d);
    for (int i = 0; i < 3; ++i) {
      d += (knot - at.pressure) / at.pressure_slope;
      at = path_at(d);
    }
    if (std::abs(knot - at.pressure) > 1e-12 * std::abs(at.pressure) + 1e-9 * std::abs(surface_.vertex_pressure())) {
      return std::nullopt;
    }
    Residual r = evaluate(surface_, d, at);
    const double g = surface_.hull().y()[right];
    const YieldSurface::Cap cap = surface_.cap(at.pressure, at.crush_pressure);
    const auto with_slope = [&](std::size_t segment) {
      const double slope = surface_.hull().slope_of_segment(segment);
      const double slope_sine = slope * cap.sine * cap.sine - g * std::min(cap.rho, 1.0) / cap.half_axis;
      return residual_value(d, at, g * cap.sine, slope_sine, cap.sine);
    };
    if (with_slope(right) > 0 || with_slope(right - 1) < 0) return std::nullopt;
    r.limit = g * cap.sine;
    r.value = 0;
    return r;
  }

  ReturnPoint failed(const Residual& r)
  {
    return {ReturnStatus::failed, r.d, r.at, r.at.trial_sqrt_j2, 0, r.value, n_evaluations_};
  }

  const YieldSurface& surface_;
  const Path& path_;
  int n_evaluations_ = 0;
};

}  // namespace cap_return

/// Returns the step that `path` describes to the yield surface, if it leaves it. `path(d)` gives the PathPoint after a
/// plastic volumetric strain d; it must be continuous, with pressure falling and crush pressure not falling in d.
/// `trial` is path(0), where it is known already.
template <class Path>
ReturnPoint return_to_surface(const YieldSurface& surface, const Path& path, const PathPoint& trial)
{
  return cap_return::Solver<Path>(surface, path).solve(trial);
}

template <class Path>
ReturnPoint return_to_surface(const YieldSurface& surface, const Path& path)
{
  return return_to_surface(surface, path, path(0));
}

}  // namespace tamp::components
