#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "components/materials/cap_return.hpp"
#include "components/materials/cap_step.hpp"
#include "components/materials/cap_substeps.hpp"

namespace tamp::components
{

/// The stress update of one particle of sand, for every way that it can go: the reference for CapLanes, and the one
/// that takes the substeps which CapLanes leaves to it.
///
/// A step is of second order: half of the plastic flow is taken along the surface's normal where the step starts to
/// flow
/// (`flow_start`), the rest by a return along the normal where it ends (the trapezoidal rule, yet ending exactly on the
/// surface). Where the first half does not fit the step, all of it is the return's (backward Euler, first order).
template <class Model>
class CapIntegrator
{
 public:
  CapIntegrator(const TabularCap& sand, const Model& model)
      : step_(sand, model), substeps_(sand.parameters().tolerance, sand.parameters().max_substeps)
  {
  }

  const CapStep<Model>& step() const { return step_; }
  const CapSubsteps& substeps() const { return substeps_; }
  UpdateCounts& counts() { return counts_; }

  /// Takes one step, in as many substeps as its error estimate asks for.
  CapOutcome advance(const CapParticle& particle, const CapStrain& strain)
  {
    CapOutcome at{particle, 0};
    CapProgress progress;
    while (true) {
      const CapOutcome tried = substep(at.now, strain, progress.size);
      const Verdict verdict = substeps_.judge(progress, tried.error, counts_);
      if (verdict != Verdict::again) at = tried;
      if (verdict == Verdict::end) return at;
    }
  }

  /// Takes one substep; nothing is counted but evaluations of the elastic model.
  CapOutcome substep(const CapParticle& old, const CapStrain& strain, double size)
  {
    const double compaction = size * strain.compaction;
    if (step_.form() == ElasticUpdate::state) {
      return substep_along(old, strain, size, [&](const Deviatoric& deviatoric, double d, double) {
        return step_.state_path(old, compaction, deviatoric, d);
      });
    }
    return substep_along(old, strain, size, [&](const Deviatoric& deviatoric, double d, double d_middle) {
      ++counts_.modulus_evaluations;
      return step_.rate_path(old, compaction, deviatoric, d, d_middle);
    });
  }

 private:
  using Deviatoric = DeviatoricTrialOf<double>;
  using Combination = CombinationOf<double>;

  /// `path(deviatoric, d, d_middle)` is the path that is left after a plastic volumetric strain d ahead of the return,
  /// where it is d_middle in the middle of the step.
  template <class MakePath>
  CapOutcome substep_along(const CapParticle& old, const CapStrain& strain, double size, const MakePath& path)
  {
    const Deviatoric deviatoric = step_.deviatoric(old, strain, size);
    const auto whole = path(deviatoric, 0, 0);
    const PathPoint trial = whole(0);
    count_path(1);
    if (inside(step_.yield(), trial)) return step_.after_elastic(old, strain, size, trial);

    const Combination all{0, 1};
    if (trial.pressure < step_.yield().vertex_pressure()) {
      // At the vertex the surface has no one normal, and a return alone is exact.
      const VertexReturn back = vertex_return(path, deviatoric, whole, trial);
      if (back.value <= 0) {
        return step_.after_flow(old, strain, size, FlowStart{}, Combination{1, 0}, all, back.point(step_.yield()));
      }
    }
    const auto ended = [&](const FlowStart& start, const Combination& along, const Combination& left,
                           const ReturnPoint& point) {
      const double d = start.plastic_volumetric + point.plastic_volumetric;
      if (step_.ends_dilation() && d < step_.most_dilation(old)) {
        return after_last_dilation(path, old, strain, size, deviatoric, whole, trial, start, along);
      }
      return step_.after_flow(old, strain, size, start, along, left, point);
    };
    FlowStart start = flow_start(step_.yield(), old, deviatoric, trial);
    if (start.on_kink) start.normal = normal_of_kink(step_.yield(), start.pressure, trial.crush_pressure);
    const Combination along = start.along(trial.shear_modulus);
    if (start.multiplier > 0) {
      const Combination left = start.left(along);
      const auto rest = path(left.trial(deviatoric), start.plastic_volumetric, start.plastic_volumetric);
      const ReturnPoint point = return_to_surface(step_.yield(), rest, rest(0), start.guess);
      count_path(point.n_evaluations);
      if (point.status == ReturnStatus::cone_or_cap) return ended(start, along, left, point);
      start.multiplier = start.plastic_volumetric = 0;
    }
    return ended(start, along, all, return_alone(path, deviatoric, whole, trial));
  }

  /// The end of a flow whose normal asks for more dilation than the sand has left. What would then lie beyond the
  /// tension vertex returns there, and is stretched.
  template <class MakePath, class Path>
  CapOutcome after_last_dilation(const MakePath& path, const CapParticle& old, const CapStrain& strain, double size,
                                 const Deviatoric& deviatoric, const Path& whole, const PathPoint& trial,
                                 FlowStart start, const Combination& along)
  {
    const Combination all{0, 1};
    const double d = step_.most_dilation(old);
    const PathPoint at = path(deviatoric, 0, 0.5 * d)(d);
    count_path(1);
    if (at.pressure < step_.yield().vertex_pressure()) {
      const VertexReturn back = vertex_return(path, deviatoric, whole, trial);
      return step_.after_flow(old, strain, size, FlowStart{}, Combination{1, 0}, all, back.point(step_.yield()));
    }
    start.multiplier = start.plastic_volumetric = 0;
    return step_.after_flow(old, strain, size, start, along, all, cap_return::end_of_dilation(step_.yield(), d, at));
  }

  using VertexReturn = cap_return::VertexReturnOf<double>;

  /// The return to the tension vertex. The rate form returns twice, to know the middle of the step.
  template <class MakePath, class Path>
  VertexReturn vertex_return(const MakePath& path, const Deviatoric& deviatoric, const Path& whole,
                             const PathPoint& trial)
  {
    VertexReturn back = cap_return::return_to_vertex(step_.yield(), whole, trial, true);
    count_path(static_cast<int>(back.n_evaluations));
    if (step_.form() == ElasticUpdate::state || !(back.value <= 0)) return back;
    const Path middle = path(deviatoric, 0, 0.5 * back.end.d);
    return cap_return::return_to_vertex(step_.yield(), middle, middle(0), true);
  }

  /// All the flow along the normal at the end. The rate form returns twice, to know the middle of the step.
  template <class MakePath, class Path>
  ReturnPoint return_alone(const MakePath& path, const Deviatoric& deviatoric, const Path& whole,
                           const PathPoint& trial)
  {
    const ReturnPoint first = return_to_surface(step_.yield(), whole, trial);
    count_path(first.n_evaluations - 1);
    if (step_.form() == ElasticUpdate::state) return first;
    return return_to_surface(step_.yield(), path(deviatoric, 0, 0.5 * first.plastic_volumetric));
  }

  /// The state form asks the elastic model at every point of its path.
  void count_path(int n_evaluations)
  {
    if (step_.form() == ElasticUpdate::state) counts_.modulus_evaluations += static_cast<std::size_t>(n_evaluations);
  }

  CapStep<Model> step_;
  CapSubsteps substeps_;
  UpdateCounts counts_;
};

}  // namespace tamp::components
