#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "components/materials/cap_flow.hpp"
#include "components/materials/cap_return.hpp"
#include "components/materials/tabular_cap.hpp"

namespace tamp::components
{

/// The stress update of one particle of sand. Pressures and volumetric strains compression positive.

template <int D>
struct CapParticle {
  SymmetricTensor<D> deviator;  // of the stress
  double pressure;
  CapState state;
  double plastic_work;
  double error;  // estimated stress error of the step that led here, relative
  bool returned;
};

/// The state form: pressure and modulus after plastic strain d are the surface's; G is the mean of both ends' of the
/// step (trapezoidal rule).
template <class Model>
struct StatePath {
  const Model& model;
  std::size_t& n_evaluations;
  const PiecewiseLinear& crush_curve;
  DeviatoricTrial deviatoric;
  double elastic_trial, plastic_old, modulus_old, shear_ratio;

  PathPoint operator()(double d) const
  {
    ++n_evaluations;
    const double plastic = plastic_old + d;
    const ElasticPoint elastic = model.at(elastic_trial - d, plastic);
    const PiecewiseLinear::Value crush = crush_curve.at(std::max(plastic, 0.0));
    const double shear = shear_ratio * 0.5 * (modulus_old + elastic.bulk_modulus);
    return {elastic.pressure,
            elastic.coupling - elastic.bulk_modulus,
            crush.value,
            plastic > 0 ? crush.slope : 0,
            elastic.bulk_modulus,
            shear,
            deviatoric.sqrt_j2(shear)};
  }
};

/// The rate form with one modulus for the step: p = p_trial - K d.
struct RatePath {
  static constexpr bool constant_moduli = true;

  const PiecewiseLinear& crush_curve;
  double pressure_trial, plastic_old, bulk_modulus, shear_modulus, trial_sqrt_j2;

  PathPoint operator()(double d) const
  {
    const double plastic = plastic_old + d;
    const PiecewiseLinear::Value crush = crush_curve.at(std::max(plastic, 0.0));
    return {pressure_trial - bulk_modulus * d,
            -bulk_modulus,
            crush.value,
            plastic > 0 ? crush.slope : 0,
            bulk_modulus,
            shear_modulus,
            trial_sqrt_j2};
  }
};

/// Steps of second order: half of the plastic flow is taken along the surface's normal where the step starts to flow
/// (`flow_start`), the rest by a return along the normal where it ends (the trapezoidal rule, yet ending exactly on the
/// surface). Where the first half does not fit the step, all of it is the return's (backward Euler, first order).
template <int D, class Model>
class CapIntegrator
{
 public:
  using Tensor = SymmetricTensor<D>;
  using Particle = CapParticle<D>;

  CapIntegrator(const TabularCap& sand, const Model& model)
      : yield_(sand.parameters().yield),
        crush_curve_(sand.parameters().crush_curve),
        model_(model),
        shear_ratio_(sand.shear_ratio()),
        tolerance_(sand.parameters().tolerance),
        least_size_((1 + 1e-6) / sand.parameters().max_substeps),
        form_(sand.parameters().elastic_update)
  {
  }

  /// One step, in as many substeps as its error estimate asks for.
  Particle advance(const Tensor& stress, const CapState& state, const Tensor& strain_increment)
  {
    const Particle old = start(stress, state);
    const Tensor e = deviator(strain_increment);
    const double compaction = -trace(strain_increment);
    Particle now = substep(old, e, compaction);
    if (now.error <= tolerance_ && now.returned) {
      ++counts_.substeps;
    } else {
      now = advance_cut(old, e, compaction, now);
    }
    counts_.extrapolated += !in_range(now);
    return now;
  }

  const UpdateCounts& counts() const { return counts_; }

 private:
  Particle start(const Tensor& stress, const CapState& state)
  {
    Particle old{deviator(stress), -trace(stress) / 3, state, 0, 0, true};
    if (!(state.bulk_modulus > 0)) old.state.bulk_modulus = initial_modulus(old);
    return old;
  }

  double initial_modulus(const Particle& old)
  {
    const double elastic = old.state.elastic_volumetric, plastic = old.state.plastic_volumetric;
    return form_ == ElasticUpdate::state ? model_.at(elastic, plastic).bulk_modulus
                                         : rate_modulus(old.pressure, elastic, plastic);
  }

  bool in_range(const Particle& now) const
  {
    const double elastic = now.state.elastic_volumetric, plastic = now.state.plastic_volumetric;
    return form_ == ElasticUpdate::state ? model_.in_range(elastic, plastic)
                                         : model_.rate_in_range(now.pressure, elastic, plastic);
  }

  double rate_modulus(double pressure, double elastic, double plastic)
  {
    ++counts_.modulus_evaluations;
    return model_.rate_modulus(pressure, elastic, plastic);
  }

  /// Substeps whose errors stay within their share of the tolerance.
  Particle advance_cut(const Particle& old, const Tensor& e, double compaction, const Particle& whole)
  {
    Particle at = old;
    double done = 0, size = next_size(1, whole);
    ++counts_.split_updates;
    while (done < 1) {
      // The remainder is cut evenly.
      const double rest = 1 - done;
      size = rest / std::ceil(rest / size - 1e-9);
      // An even cut may come out longer than the least size by what the cut forgives.
      const bool least = size <= least_size_ * (1 + 1e-8), last = size == rest;
      const Particle now = substep(at, size * e, size * compaction);
      const bool accurate = now.returned && now.error <= tolerance_ * size;
      const double next = next_size(size, now);
      if (accurate || least) {
        ++counts_.substeps;
        counts_.limited_substeps += !accurate;
        at = now;
        if (!now.returned || last) return at;
        done += size;
      }
      size = next;
    }
    return at;
  }

  /// What the error of the last try allows: it goes as the cube of the size, its share of the tolerance as the size.
  double next_size(double size, const Particle& tried) const
  {
    const double room = tolerance_ * size / std::max(tried.error, 1e-4 * tolerance_ * size);
    const double factor = tried.returned ? std::clamp(0.9 * std::sqrt(room), 0.1, 4.0) : 0.25;
    return std::max(size * factor, least_size_);
  }

  Particle substep(const Particle& old, const Tensor& e, double compaction)
  {
    const DeviatoricTrial deviatoric = deviatoric_trial(old.deviator, e);
    if (form_ == ElasticUpdate::state) {
      const auto path = [&](const DeviatoricTrial& products, double d, double) {
        return StatePath<Model>{model_,
                                counts_.modulus_evaluations,
                                crush_curve_,
                                products,
                                old.state.elastic_volumetric + compaction - d,
                                old.state.plastic_volumetric + d,
                                old.state.bulk_modulus,
                                shear_ratio_};
      };
      return substep_along(path, old, e, compaction, deviatoric);
    }
    // The modulus of the step's middle.
    const auto path = [&](const DeviatoricTrial& products, double d, double d_middle) {
      const double elastic = 0.5 * compaction - d_middle;
      const double modulus =
          rate_modulus(old.pressure + old.state.bulk_modulus * elastic, old.state.elastic_volumetric + elastic,
                       old.state.plastic_volumetric + d_middle);
      const double shear = shear_ratio_ * modulus;
      return RatePath{crush_curve_,
                      old.pressure + modulus * (compaction - d),
                      old.state.plastic_volumetric + d,
                      modulus,
                      shear,
                      products.sqrt_j2(shear)};
    };
    return substep_along(path, old, e, compaction, deviatoric);
  }

  /// `path(products, d, d_middle)` is the path that is left after a plastic volumetric strain d ahead of the return,
  /// where it is d_middle in the middle of the step.
  template <class MakePath>
  Particle substep_along(const MakePath& path, const Particle& old, const Tensor& e, double compaction,
                         const DeviatoricTrial& deviatoric)
  {
    const auto whole = path(deviatoric, 0, 0);
    const PathPoint trial = whole(0);
    if (inside(yield_, trial)) return after_elastic(old, e, compaction, deviatoric, trial);
    return flowing(path, whole, trial, old, e, compaction, deviatoric);
  }

  /// Apart from `substep_along`, so that an elastic step, the most frequent, is a small function.
  template <class MakePath, class Path>
  [[gnu::noinline]] Particle flowing(const MakePath& path, const Path& whole, const PathPoint& trial,
                                     const Particle& old, const Tensor& e, double compaction,
                                     const DeviatoricTrial& deviatoric)
  {
    if (trial.pressure < yield_.vertex_pressure()) {
      // At the vertex the surface has no one normal, and a return alone is exact.
      const ReturnPoint point = return_alone(path, deviatoric, whole, trial);
      if (point.status == ReturnStatus::tension_vertex) {
        return after(old, e, compaction, deviatoric, {}, old.deviator, point);
      }
    }
    const double old_crush = crush_curve_(std::max(old.state.plastic_volumetric, 0.0));
    FlowStart start = flow_start(yield_, old.pressure, old_crush, deviatoric, trial);
    const Tensor along = old.deviator + (2 * trial.shear_modulus * start.fraction) * e;
    if (start.multiplier > 0) {
      const Tensor plastic = (0.5 * start.multiplier / start.sqrt_j2) * along, left = e - plastic;
      const auto rest = path(deviatoric_trial(old.deviator, left), start.plastic_volumetric, start.plastic_volumetric);
      const ReturnPoint point = return_to_surface(yield_, rest, rest(0), start.guess);
      if (point.status == ReturnStatus::cone_or_cap) {
        return after(old, left, compaction, deviatoric, start, along, point);
      }
      start.multiplier = start.plastic_volumetric = 0;
    }
    const ReturnPoint point = return_alone(path, deviatoric, whole, trial);
    return after(old, e, compaction, deviatoric, start, along, point);
  }

  /// All the flow along the normal at the end. The rate form returns twice, to know the middle of the step.
  template <class MakePath, class Path>
  ReturnPoint return_alone(const MakePath& path, const DeviatoricTrial& deviatoric, const Path& whole,
                           const PathPoint& trial)
  {
    const ReturnPoint first = return_to_surface(yield_, whole, trial);
    if (form_ == ElasticUpdate::state) return first;
    return return_to_surface(yield_, path(deviatoric, 0, 0.5 * first.plastic_volumetric));
  }

  Particle after_elastic(const Particle& old, const Tensor& e, double compaction, const DeviatoricTrial& deviatoric,
                         const PathPoint& trial) const
  {
    CapState state = old.state;
    state.elastic_volumetric += compaction;
    state.bulk_modulus = trial.bulk_modulus;
    const double error = modulus_error(old, trial.pressure, deviatoric, trial) /
                         error_scale(old, trial.pressure, trial.trial_sqrt_j2, trial);
    const bool returned = std::isfinite(trial.pressure + error);
    return {old.deviator + 2 * trial.shear_modulus * e, trial.pressure, state, old.plastic_work, error, returned};
  }

  /// The end of a step that flowed: the stress deviator was `along` when that started, and `left` of the deviatoric
  /// strain when the plastic strain ahead of the return had been taken off it.
  Particle after(const Particle& old, const Tensor& left, double compaction, const DeviatoricTrial& deviatoric,
                 const FlowStart& start, const Tensor& along, const ReturnPoint& point) const
  {
    const double d = start.plastic_volumetric + point.plastic_volumetric, trial = point.at.trial_sqrt_j2;
    const double multiplier = start.multiplier + point.multiplier;
    const Tensor trial_deviator = old.deviator + 2 * point.at.shear_modulus * left;
    Particle now;
    now.deviator = trial > 0 ? Tensor(trial_deviator * (point.sqrt_j2 / trial)) : trial_deviator;
    now.pressure = point.at.pressure;
    now.state = {old.state.elastic_volumetric + compaction - d, old.state.plastic_volumetric + d,
                 old.state.equivalent_plastic + multiplier / std::numbers::sqrt3, point.at.bulk_modulus,
                 old.state.n_failures};
    // Each half of the flow works at its own end of the step, where the stress is on the surface: that is never
    // negative, as the surface is convex around zero. At the apex flow has one direction, and the mean pressure is more
    // accurate.
    const double flow_pressure =
        point.status == ReturnStatus::apex ? 0.5 * (start.pressure + now.pressure) : now.pressure;
    now.plastic_work = old.plastic_work + start.pressure * start.plastic_volumetric + start.sqrt_j2 * start.multiplier +
                       flow_pressure * point.plastic_volumetric + point.sqrt_j2 * point.multiplier;
    const double scale = error_scale(old, now.pressure, point.sqrt_j2, point.at);
    double error = modulus_error(old, now.pressure, deviatoric, point.at);
    if (point.status == ReturnStatus::cone_or_cap) {
      // A deviator of nothing but round-off has no direction.
      const bool sheared = start.sqrt_j2 > cap_return::no_shear * point.at.crush_pressure && trial > 0;
      const double cosine = sheared ? double_dot(along, trial_deviator) / (2 * start.sqrt_j2 * trial) : 1;
      error += flow_error(start, point, cosine);
    }
    now.error = error / scale;
    now.returned = point.status != ReturnStatus::failed && std::isfinite(now.pressure + point.sqrt_j2 + now.error);
    return now;
  }

  static double error_scale(const Particle& old, double pressure, double sqrt_j2, const PathPoint& at)
  {
    return std::max(std::max(old.pressure, pressure), std::max(sqrt_j2, 0.1 * at.crush_pressure));
  }

  /// The error of taking one modulus for the whole step [Pa]: in the deviator and, in rate form, in the pressure too.
  double modulus_error(const Particle& old, double pressure, const DeviatoricTrial& deviatoric,
                       const PathPoint& at) const
  {
    const double modulus_old = old.state.bulk_modulus;
    double change = (at.bulk_modulus - modulus_old) / (at.bulk_modulus + modulus_old);
    double stress = 2 * at.shear_modulus * std::sqrt(deviatoric.increment_j2);
    if (form_ == ElasticUpdate::rate) {
      // This modulus is of the step's middle, the old one may be of its start.
      change *= 2;
      stress += std::abs(pressure - old.pressure);
    }
    return change * change * stress;
  }

  const YieldSurface& yield_;
  const PiecewiseLinear& crush_curve_;
  const Model& model_;
  double shear_ratio_, tolerance_, least_size_;
  ElasticUpdate form_;
  UpdateCounts counts_;
};

}  // namespace tamp::components
