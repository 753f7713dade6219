#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "components/materials/return_point.hpp"

namespace tamp::components::cap_return
{

/// Newton's method for the return, on the cone in d alone and on the cap in d and the cap's angle. It mostly settles in
/// two or three evaluations of the path. Nothing where it strays or does not settle: the bracketed solution follows.
template <class Path>
class Newton
{
 public:
  /// `n_evaluations` of the path are counted on.
  Newton(const YieldSurface& surface, const Path& path, int& n_evaluations)
      : surface_(surface), path_(path), n_evaluations_(n_evaluations)
  {
  }

  /// On the cone, phi(d) = d + (qt - g)/G g'. It is straight where path and envelope are.
  std::optional<ReturnPoint> on_cone(const PathPoint& trial, double d)
  {
    Before before{trial, 0};
    PathPoint at = path_at(d);
    for (int i = 0; i < max_newton; ++i) {
      const YieldSurface::Strength g = surface_.strength(at.pressure);
      if (!g.segment) return std::nullopt;
      const auto [shear_d, trial_d] = before.slopes(at, d);
      const double compliance = 1 / at.shear_modulus, multiplier = (at.trial_sqrt_j2 - g.value) * compliance;
      const double multiplier_d = (trial_d - g.slope * at.pressure_slope - multiplier * shear_d) * compliance;
      const double step = -(d + multiplier * g.slope) / (1 + multiplier_d * g.slope);
      // On one segment a path with constant moduli has a linear phi.
      constexpr bool linear = requires
      {
        Path::constant_moduli;
      };
      const bool settled = std::abs(step) <= strain_tolerance + newton_tolerance * std::abs(d);
      if (settled || linear) {
        const Residual end =
            settled ? stepped(at, d, step, shear_d, trial_d) : evaluate(surface_, d + step, path_at(d + step));
        const bool valid = end.segment == g.segment && end.normal.sine == 1 && end.at.trial_sqrt_j2 >= end.limit;
        if (valid) return surface_point(end, n_evaluations_);
        if (settled) return std::nullopt;
      }
      before = {at, d};
      d += step;
      if (!std::isfinite(d)) return std::nullopt;
      at = path_at(d);
    }
    return std::nullopt;
  }

  /// On the cap, for (d, t), t the tangent of half the cap's angle: sin = 2t/(1+t^2), cos = (1-t^2)/(1+t^2). Then the
  /// apex is no singular point. The equations are p(d) = kappa + a cos and phi sin = 0.
  struct OnCap {
    double d, t;
  };
  std::optional<ReturnPoint> on_cap(const PathPoint& trial, const OnCap& guess)
  {
    auto [d, t] = guess;
    const double r = surface_.cap_ellipticity(), vertex = surface_.vertex_pressure();
    Before before{trial, 0};
    PathPoint at = d == 0 ? trial : path_at(d);
    for (int i = 0; i < max_newton; ++i) {
      const double kappa = vertex + r * (at.crush_pressure - vertex), half_axis = at.crush_pressure - kappa;
      const double unit = 1 / (1 + t * t), sine = 2 * t * unit, cosine = (1 - t * t) * unit;
      const double sine_t = 2 * cosine * unit, cosine_t = -2 * sine * unit;
      const YieldSurface::Strength g = surface_.strength(kappa + half_axis * cosine);
      const double g_t = g.slope * half_axis * cosine_t;
      const double pressure_d = (r + (1 - r) * cosine) * at.crush_slope, g_d = g.slope * pressure_d;
      const auto [shear_d, trial_d] = before.slopes(at, d);

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
        if (!(multiplier >= 0)) return std::nullopt;
        const Residual end = stepped(at, d, d_step, shear_d, trial_d);
        const bool valid = end.at.pressure <= end.at.crush_pressure && end.normal.sine < 1;
        return valid ? std::optional(surface_point(end, n_evaluations_)) : std::nullopt;
      }
      before = {at, d};
      d += d_step;
      t += t_step;
      if (!std::isfinite(d + t)) return std::nullopt;
      at = path_at(d);
    }
    return std::nullopt;
  }

  /// Where to start on the cap without a guess: at the trial's place above the cap, or for a trial beyond the apex from
  /// phi with h_p sin ~ -g/a, sin = qt g / (g^2 + a G d), d that of the apex and then of that point.
  OnCap start_on_cap(const PathPoint& trial) const
  {
    const YieldSurface::Cap cap = surface_.cap(trial.pressure, trial.crush_pressure);
    if (trial.pressure <= trial.crush_pressure) return {0, half_tangent(cap.sine, std::min(cap.rho, 1.0))};
    const double closing = trial.crush_slope - trial.pressure_slope;
    const double apex = (trial.pressure - trial.crush_pressure) / closing;
    const double g = surface_.strength(trial.crush_pressure).value;
    OnCap start{apex, 0};
    for (int i = 0; i < 3; ++i) {
      const double softening = cap.half_axis * trial.shear_modulus * start.d;
      const double sine = std::min(trial.trial_sqrt_j2 * g / (g * g + softening), 0.9);
      const double cosine = std::sqrt(1 - sine * sine);
      start = {apex + cap.half_axis * (1 - cosine) / closing, half_tangent(sine, cosine)};
    }
    return start;
  }

  std::optional<ReturnPoint> from_guess(const PathPoint& trial, const ReturnGuess& guess)
  {
    if (guess.sine >= 1) return on_cone(trial, guess.plastic_volumetric);
    const double cosine = std::sqrt((1 - guess.sine) * (1 + guess.sine));
    return on_cap(trial, {guess.plastic_volumetric, half_tangent(guess.sine, cosine)});
  }

 private:
  /// tan(theta / 2)
  static double half_tangent(double sine, double cosine) { return sine / (1 + cosine); }

  /// The path gives no derivatives of G and of the trial sqrt(J2): secants from the evaluation before do.
  struct Before {
    PathPoint at;
    double d;

    struct Slopes {
      double shear_d, trial_d;
    };
    Slopes slopes(const PathPoint& now, double d_now) const
    {
      const double change = d_now == d ? 0 : 1 / (d_now - d);
      return {(now.shear_modulus - at.shear_modulus) * change, (now.trial_sqrt_j2 - at.trial_sqrt_j2) * change};
    }
  };

  PathPoint path_at(double d)
  {
    ++n_evaluations_;
    return path_(d);
  }

  /// The last step, taken along the path's tangent: what that leaves out is of the order of the step squared.
  Residual stepped(PathPoint at, double d, double step, double shear_d, double trial_d) const
  {
    at.pressure += at.pressure_slope * step;
    at.crush_pressure += at.crush_slope * step;
    at.shear_modulus += shear_d * step;
    at.trial_sqrt_j2 += trial_d * step;
    return evaluate(surface_, d + step, at);
  }

  const YieldSurface& surface_;
  const Path& path_;
  int& n_evaluations_;
};

}  // namespace tamp::components::cap_return
