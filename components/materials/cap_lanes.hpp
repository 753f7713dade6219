#pragma once

#include "components/materials/cap_newton.hpp"
#include "components/materials/cap_step.hpp"
#include "components/materials/cap_vertex.hpp"
#include "components/numbers.hpp"

namespace tamp::components
{

/// A substep of as many particles of sand side by side as a register holds, on the ways that most of them go: elastic,
/// to the tension vertex, or on the cone or the cap by Newton's method from the flow at the start. The formulas are
/// CapIntegrator's, and so are the bits. A particle that leaves these ways is `left` to it.
template <class Model>
class CapLanes
{
 public:
  using Particles = CapParticleOf<Lanes>;
  using Strains = CapStrainOf<Lanes>;
  using Point = PathPointOf<Lanes>;
  using Some = Mask<Lanes>;

  explicit CapLanes(const CapStep<Model>& step) : step_(step) {}

  /// Where a particle likely goes, from where it is: 0 for the tension vertex, 1 for the cone, 2 for the cap.
  static constexpr std::size_t n_ways = 3;
  Lanes likely_way(const Particles& from) const
  {
    const Some on_cap = from.pressure > step_.yield().kappa(step_.crush_pressure(from.plastic_volumetric));
    return select(from.pressure < 0.0, Lanes(0.0), select(on_cap, Lanes(2.0), Lanes(1.0)));
  }

  struct Outcome {
    CapOutcomeOf<Lanes> end;
    Some left;
    Lanes n_evaluations;  ///< evaluations of the elastic model, for particles that were not left
  };
  [[gnu::flatten]] Outcome substep(const Particles& old, const Strains& strain, const Lanes& size) const
  {
    const Lanes compaction = size * strain.compaction;
    if (step_.form() == ElasticUpdate::state) {
      return substep_along(old, strain, size, [&](const Deviatoric& deviatoric, const Lanes& d, const Lanes&) {
        return step_.state_path(old, compaction, deviatoric, d);
      });
    }
    return substep_along(old, strain, size, [&](const Deviatoric& deviatoric, const Lanes& d, const Lanes& d_middle) {
      return step_.rate_path(old, compaction, deviatoric, d, d_middle);
    });
  }

 private:
  using Deviatoric = DeviatoricTrialOf<Lanes>;

  bool asks_along_path() const { return step_.form() == ElasticUpdate::state; }

  /// `path(deviatoric, d, d_middle)` is the path that is left after a plastic volumetric strain d ahead of the return,
  /// where it is d_middle in the middle of the step.
  template <class MakePath>
  Outcome substep_along(const Particles& old, const Strains& strain, const Lanes& size, const MakePath& path) const
  {
    const Deviatoric deviatoric = step_.deviatoric(old, strain, size);
    const auto whole = path(deviatoric, Lanes(0.0), Lanes(0.0));
    const Point trial = whole(Lanes(0.0));
    const Some elastic = inside(step_.yield(), trial);
    Outcome outcome{{}, Some(false), 1.0};
    if (any(elastic)) outcome.end = step_.after_elastic(old, strain, size, trial);
    Some flowing = !elastic;
    const Some tension = trial.pressure < step_.yield().vertex_pressure();
    if (any(tension)) {
      flowing = flowing && !flow_to_vertex(path, old, strain, size, deviatoric, whole, trial, tension, outcome);
    }
    if (any(flowing)) flow(path, old, strain, size, deviatoric, trial, flowing, outcome);
    return outcome;
  }

  /// All of the flow is the return's, to the tension vertex, for the lanes in its normal cone, which are answered. The
  /// rate form returns twice, to know the middle of the step.
  template <class MakePath, class Path>
  Some flow_to_vertex(const MakePath& path, const Particles& old, const Strains& strain, const Lanes& size,
                      const Deviatoric& deviatoric, const Path& whole, const Point& trial, const Some& tension,
                      Outcome& outcome) const
  {
    const YieldSurface& yield = step_.yield();
    cap_return::VertexReturnOf<Lanes> back = cap_return::return_to_vertex(yield, whole, trial, tension);
    Some at_vertex = tension && back.value <= 0.0;
    add_where(tension, asks_along_path() ? back.n_evaluations : Lanes(0.0), outcome.n_evaluations);
    if (!asks_along_path()) {
      add_where(at_vertex, 1.0, outcome.n_evaluations);
      const Path middle = path(deviatoric, Lanes(0.0), Lanes(0.5 * back.end.d));
      back = cap_return::return_to_vertex(yield, middle, middle(Lanes(0.0)), at_vertex);
      at_vertex = at_vertex && back.value <= 0.0;
    }
    const CombinationOf<Lanes> stress{1.0, 0.0}, all{0.0, 1.0};
    const CapOutcomeOf<Lanes> end =
        step_.after_flow(old, strain, size, FlowStartOf<Lanes>{}, stress, all, back.point(yield));
    assign_where(at_vertex, end, outcome.end);
    return at_vertex;
  }

  template <class MakePath>
  void flow(const MakePath& path, const Particles& old, const Strains& strain, const Lanes& size,
            const Deviatoric& deviatoric, const Point& trial, const Some& flowing, Outcome& outcome) const
  {
    const YieldSurface& yield = step_.yield();
    const FlowStartOf<Lanes> start = flow_start(yield, old, deviatoric, trial);
    const CombinationOf<Lanes> along = start.along(trial.shear_modulus), left = start.left(along);
    const auto rest = path(left.trial(deviatoric), start.plastic_volumetric, start.plastic_volumetric);
    const Point rest_trial = rest(Lanes(0.0));

    const Some returns = flowing && start.multiplier > 0.0;
    const Some on_cone = start.guess.sine >= 1.0;
    Return back;
    return_on_cone(rest, rest_trial, start.guess, returns && on_cone, back);
    return_on_cap(rest, rest_trial, start.guess, returns && !on_cone, back);
    const ReturnPointOf<Lanes> point = cap_return::surface_point(back.end, 0);
    assign_where(flowing, step_.after_flow(old, strain, size, start, along, left, point), outcome.end);
    outcome.left = flowing && !back.found;
    add_where(flowing, asks_along_path() ? back.n_evaluations : Lanes(1.0), outcome.n_evaluations);
    if (!step_.ends_dilation()) return;
    const Some beyond = flowing && start.plastic_volumetric + back.end.d < step_.most_dilation(old);
    if (any(beyond)) end_dilation(path, old, strain, size, deviatoric, start, along, beyond, outcome);
  }

  /// The end of the flow in lanes whose normal asks for more dilation than the sand has left.
  template <class MakePath>
  void end_dilation(const MakePath& path, const Particles& old, const Strains& strain, const Lanes& size,
                    const Deviatoric& deviatoric, FlowStartOf<Lanes> start, const CombinationOf<Lanes>& along,
                    const Some& beyond, Outcome& outcome) const
  {
    const YieldSurface& yield = step_.yield();
    const Lanes d = step_.most_dilation(old);
    const Point at = path(deviatoric, Lanes(0.0), Lanes(0.5 * d))(d);
    add_where(beyond, 1.0, outcome.n_evaluations);
    start.multiplier = start.plastic_volumetric = 0.0;
    const CombinationOf<Lanes> all{0.0, 1.0};
    const ReturnPointOf<Lanes> point = cap_return::end_of_dilation(yield, d, at);
    assign_where(beyond, step_.after_flow(old, strain, size, start, along, all, point), outcome.end);
    outcome.left = outcome.left || (beyond && at.pressure < yield.vertex_pressure());
  }

  struct Return {
    cap_return::ResidualOf<Lanes> end{};
    Some found{false};
    Lanes n_evaluations = 1.0;
  };

  /// Newton's method for the lanes that are `active`, each until it has converged.
  template <class Path>
  void return_on_cone(const Path& path, const Point& trial, const ReturnGuessOf<Lanes>& guess, Some active,
                      Return& back) const
  {
    using namespace cap_return;
    const YieldSurface& yield = step_.yield();
    Lanes d = guess.plastic_volumetric;
    BeforeOf<Path, Lanes> before{trial, 0.0};
    if (!any(active)) return;
    Point at = path(d);
    add_where(active, 1.0, back.n_evaluations);
    for (int i = 0; i < max_newton; ++i) {
      const auto g = yield.strength(at.pressure);
      const auto [shear_d, trial_d] = before.slopes(at, d);
      const Lanes step = step_on_cone(g, at, shear_d, trial_d, d);
      const Some settled = has_converged(step, d);
      active = active && at.pressure >= yield.vertex_pressure() && is_finite(Lanes(d + step));
      before = {at, d};
      d = d + step;
      if constexpr (has_constant_moduli<Path>) {
        at = path(d);
        take(active, evaluate(yield, d, at), g.slope, back);
      } else {
        take(active && settled, stepped(yield, at, before.d, step, shear_d, trial_d), g.slope, back);
      }
      active = active && !settled && !back.found;
      if (!any(active)) return;
      if constexpr (!has_constant_moduli<Path>) at = path(d);
      add_where(active, 1.0, back.n_evaluations);
    }
  }
  void take(const Some& ends, const cap_return::ResidualOf<Lanes>& end, const Lanes& slope, Return& back) const
  {
    const Some valid = ends && cap_return::is_on_segment(step_.yield(), end, slope);
    assign_where(valid, end, back.end);
    back.found = back.found || valid;
  }

  template <class Path>
  void return_on_cap(const Path& path, const Point& trial, const ReturnGuessOf<Lanes>& guess, Some active,
                     Return& back) const
  {
    using namespace cap_return;
    const YieldSurface& yield = step_.yield();
    const Lanes sine = guess.sine;
    Lanes d = guess.plastic_volumetric, t = half_tangent(sine, Lanes(sqrt((1.0 - sine) * (1.0 + sine))));
    BeforeOf<Path, Lanes> before{trial, 0.0};
    if (!any(active)) return;
    Point at = path(d);
    add_where(active && d != 0.0, 1.0, back.n_evaluations);
    Some settled{false};
    Lanes shear_d = 0.0, trial_d = 0.0;
    StepOnCap<Lanes> step{};
    for (int i = 0; i < max_newton; ++i) {
      const auto slopes = before.slopes(at, d);
      shear_d = slopes.shear_d;
      trial_d = slopes.trial_d;
      step = step_on_cap(yield, at, shear_d, trial_d, d, t);
      settled = settled || (active && has_converged(step, d, t));
      const Lanes next_d = d + step.d, next_t = t + step.t;
      active = active && !settled && is_finite(Lanes(next_d + next_t));
      if (!any(active)) break;
      // A lane at its end stays there, and finds the same last step again.
      assign_where(active, BeforeOf<Path, Lanes>{at, d}, before);
      d = select(active, next_d, d);
      t = select(active, next_t, t);
      at = path(d);
      add_where(active, 1.0, back.n_evaluations);
    }
    const ResidualOf<Lanes> end = stepped(yield, at, d, step.d, shear_d, trial_d);
    const Some valid =
        settled && step.multiplier >= 0.0 && end.at.pressure <= end.at.crush_pressure && end.normal.sine < 1.0;
    assign_where(valid, end, back.end);
    back.found = back.found || valid;
  }

  const CapStep<Model>& step_;
};

}  // namespace tamp::components
