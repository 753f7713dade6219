#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <tuple>

#include "components/materials/return_point.hpp"

namespace tamp::components::cap_return
{

/// A path whose shear modulus and trial sqrt(J2) do not change along it.
template <class Path>
inline constexpr bool has_constant_moduli = requires
{
  Path::constant_moduli;
};

/// Values of the previous evaluation, for secants in place of the derivatives of G and of the trial sqrt(J2).
template <class Path, class Number>
struct BeforeOf {
  Number shear_modulus, trial_sqrt_j2, d;

  static constexpr auto fields = std::tuple(&BeforeOf::shear_modulus, &BeforeOf::trial_sqrt_j2, &BeforeOf::d);

  BeforeOf(const PathPointOf<Number>& at, const Number& d_there)
      : shear_modulus(at.shear_modulus), trial_sqrt_j2(at.trial_sqrt_j2), d(d_there)
  {
  }

  struct Slopes {
    Number shear_d, trial_d;
  };
  Slopes slopes(const PathPointOf<Number>& now, const Number& d_now) const
  {
    if constexpr (has_constant_moduli<Path>) {
      return {0.0, 0.0};
    } else {
      const Number change = select(d_now == d, Number(0.0), 1.0 / (d_now - d));
      return {(now.shear_modulus - shear_modulus) * change, (now.trial_sqrt_j2 - trial_sqrt_j2) * change};
    }
  }
};

/// A step of Newton's method on the cone, for phi(d) = d + (qt - g)/G g'.
template <class Number, class Strength>
Number step_on_cone(const Strength& g, const PathPointOf<Number>& at, const Number& shear_d, const Number& trial_d,
                    const Number& d)
{
  const Number compliance = 1.0 / at.shear_modulus, multiplier = (at.trial_sqrt_j2 - g.value) * compliance;
  const Number multiplier_d = (trial_d - g.slope * at.pressure_slope - multiplier * shear_d) * compliance;
  return -(d + multiplier * g.slope) / (1.0 + multiplier_d * g.slope);
}

/// Whether a return on the cone ends on the segment of the envelope that it was solved for.
template <class Number>
Mask<Number> is_on_segment(const YieldSurface& surface, const ResidualOf<Number>& end, const Number& slope)
{
  return end.envelope_slope == slope && end.at.pressure >= surface.vertex_pressure() && end.normal.sine == 1.0 &&
         end.at.trial_sqrt_j2 >= end.limit;
}

/// A step of Newton's method on the cap, for (d, t), t the tangent of half the cap's angle: sin = 2t/(1+t^2), cos =
/// (1-t^2)/(1+t^2). Then the apex is no singular point. The equations are p(d) = kappa + a cos and phi sin = 0.
template <class Number>
struct StepOnCap {
  Number d, t;
  Number multiplier;  ///< dl before the step
};
template <class Number>
StepOnCap<Number> step_on_cap(const YieldSurface& surface, const PathPointOf<Number>& at, const Number& shear_d,
                              const Number& trial_d, const Number& d, const Number& t)
{
  const double r = surface.cap_ellipticity(), vertex = surface.vertex_pressure();
  const Number kappa = vertex + r * (at.crush_pressure - vertex), half_axis = at.crush_pressure - kappa;
  const Number unit = 1.0 / (1.0 + t * t), sine = 2.0 * t * unit, cosine = (1.0 - t * t) * unit;
  const Number sine_t = 2.0 * cosine * unit, cosine_t = -2.0 * sine * unit;
  const auto g = surface.strength(Number(kappa + half_axis * cosine));
  const Number g_t = g.slope * half_axis * cosine_t;
  const Number pressure_d = (r + (1.0 - r) * cosine) * at.crush_slope, g_d = g.slope * pressure_d;

  const Number compliance = 1.0 / at.shear_modulus, per_axis = 1.0 / half_axis;
  const Number multiplier = (at.trial_sqrt_j2 - g.value * sine) * compliance;
  const Number slope = g.slope * sine * sine - g.value * cosine * per_axis;  // h_p sin
  const Number off_cap = at.pressure - kappa - half_axis * cosine;
  const Number phi = d * sine + multiplier * slope;

  const Number off_cap_d = at.pressure_slope - pressure_d, off_cap_t = -half_axis * cosine_t;
  const Number multiplier_t = -(g_t * sine + g.value * sine_t) * compliance;
  const Number multiplier_d = (trial_d - g_d * sine - multiplier * shear_d) * compliance;
  const Number slope_t = 2.0 * g.slope * sine * sine_t - (g_t * cosine + g.value * cosine_t) * per_axis;
  const Number slope_d = (g.value * (1.0 - r) * at.crush_slope * per_axis - g_d) * cosine * per_axis;
  const Number phi_t = d * sine_t + multiplier_t * slope + multiplier * slope_t;
  const Number phi_d = sine + multiplier_d * slope + multiplier * slope_d;

  const Number per_off_cap = 1.0 / off_cap_d, ratio = phi_d * per_off_cap;
  const Number free_step = (ratio * off_cap - phi) / (phi_t - ratio * off_cap_t);
  const Number t_step = clamped<Number>(free_step, -0.75 * t, 0.5 * (1.0 - t));
  return {-(off_cap + off_cap_t * t_step) * per_off_cap, t_step, multiplier};
}

/// Whether both steps are so small that the next ones would be round-off.
template <class Number>
Mask<Number> has_converged(const Number& d_step, const Number& d)
{
  return abs(d_step) <= strain_tolerance + newton_tolerance * abs(d);
}
template <class Number>
Mask<Number> has_converged(const StepOnCap<Number>& step, const Number& d, const Number& t)
{
  return has_converged(step.d, d) && abs(step.t) <= 10.0 * newton_tolerance * t;
}

/// The last step, taken along the path's tangent, with an error of the order of the step squared.
template <class Number>
ResidualOf<Number> stepped(const YieldSurface& surface, PathPointOf<Number> at, const Number& d, const Number& step,
                           const Number& shear_d, const Number& trial_d)
{
  at.pressure += at.pressure_slope * step;
  at.crush_pressure += at.crush_slope * step;
  at.shear_modulus += shear_d * step;
  at.trial_sqrt_j2 += trial_d * step;
  return evaluate<Number>(surface, d + step, at);
}

/// tan(theta / 2)
template <class Number>
Number half_tangent(const Number& sine, const Number& cosine)
{
  return sine / (1.0 + cosine);
}

/// Newton's method for the return, on the cone in d alone and on the cap in d and the cap's angle. It mostly settles in
/// two or three evaluations of the path. Nothing where it strays or does not settle: the bracketed solution follows.
template <class Path>
class Newton
{
 public:
  /// Adds its evaluations of the path to `n_evaluations`.
  Newton(const YieldSurface& surface, const Path& path, int& n_evaluations)
      : surface_(surface), path_(path), n_evaluations_(n_evaluations)
  {
  }

  /// On the cone phi is straight where path and envelope are: with constant moduli its first root may do.
  std::optional<ReturnPoint> on_cone(const PathPoint& trial, double d)
  {
    Before before{trial, 0};
    PathPoint at = path_at(d);
    for (int i = 0; i < max_newton; ++i) {
      if (at.pressure < surface_.vertex_pressure()) return std::nullopt;
      const auto g = surface_.strength(at.pressure);
      const auto [shear_d, trial_d] = before.slopes(at, d);
      const double step = step_on_cone(g, at, shear_d, trial_d, d);
      const bool settled = has_converged(step, d);
      before = {at, d};
      d += step;
      if (!std::isfinite(d)) return std::nullopt;
      if (!settled || has_constant_moduli<Path>) at = path_at(d);
      if (settled || has_constant_moduli<Path>) {
        const Residual end = has_constant_moduli<Path> ? evaluate(surface_, d, at)
                                                       : stepped(surface_, at, before.d, step, shear_d, trial_d);
        if (is_on_segment(surface_, end, g.slope)) return surface_point(end, n_evaluations_);
        if (settled) return std::nullopt;
      }
    }
    return std::nullopt;
  }

  struct OnCap {
    double d, t;
  };
  std::optional<ReturnPoint> on_cap(const PathPoint& trial, const OnCap& guess)
  {
    auto [d, t] = guess;
    Before before{trial, 0};
    PathPoint at = d == 0 ? trial : path_at(d);
    for (int i = 0; i < max_newton; ++i) {
      const auto [shear_d, trial_d] = before.slopes(at, d);
      const StepOnCap<double> step = step_on_cap(surface_, at, shear_d, trial_d, d, t);
      if (has_converged(step, d, t)) {
        if (!(step.multiplier >= 0)) return std::nullopt;
        const Residual end = stepped(surface_, at, d, step.d, shear_d, trial_d);
        const bool valid = end.at.pressure <= end.at.crush_pressure && end.normal.sine < 1;
        return valid ? std::optional(surface_point(end, n_evaluations_)) : std::nullopt;
      }
      before = {at, d};
      d += step.d;
      t += step.t;
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
  using Before = BeforeOf<Path, double>;

  PathPoint path_at(double d)
  {
    ++n_evaluations_;
    return path_(d);
  }

  const YieldSurface& surface_;
  const Path& path_;
  int& n_evaluations_;
};

}  // namespace tamp::components::cap_return
