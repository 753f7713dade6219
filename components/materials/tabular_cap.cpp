#include "components/materials/tabular_cap.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "components/materials/cap_return.hpp"

namespace tamp::components
{

TabularCap::TabularCap(TabularCapParameters parameters) : parameters_(std::move(parameters))
{
  const double nu = parameters_.poisson_ratio;
  if (!(nu > -1 && nu < 0.5)) throw BadValue("Poisson's ratio " + std::to_string(nu), "a number between -1 and 0.5");
  shear_ratio_ = 1.5 * (1 - 2 * nu) / (1 + nu);

  const std::span<const double> crush = parameters_.crush_curve.y();
  for (std::size_t i = 0; i < crush.size(); ++i) {
    if (!(crush[i] > (i == 0 ? 0 : crush[i - 1]))) {
      throw BadValue("crush pressure " + std::to_string(crush[i]), "positive pressures that strictly increase",
                     static_cast<std::ptrdiff_t>(i));
    }
  }
  if (!(parameters_.tolerance > 0)) {
    throw BadValue("tolerance " + std::to_string(parameters_.tolerance), "a positive number");
  }
  if (parameters_.max_substeps < 1) {
    throw BadValue("at most " + std::to_string(parameters_.max_substeps) + " substeps", "one or more");
  }
}

double TabularCap::crush_pressure(double plastic_volumetric) const
{
  return parameters_.crush_curve(std::max(plastic_volumetric, 0.0));
}

double TabularCap::bulk_modulus(const CapState& state, double pressure) const
{
  return std::visit(
      [&](const auto& model) {
        return parameters_.elastic_update == ElasticUpdate::state
                   ? model.at(state.elastic_volumetric, state.plastic_volumetric).bulk_modulus
                   : model.bulk_modulus_at_pressure(pressure, state.plastic_volumetric);
      },
      parameters_.modulus);
}

double TabularCap::pressure(const CapState& state) const
{
  return std::visit(
      [&](const auto& model) { return model.at(state.elastic_volumetric, state.plastic_volumetric).pressure; },
      parameters_.modulus);
}

CapState TabularCap::state_at_pressure(double pressure, double plastic_volumetric) const
{
  return std::visit(
      [&](const auto& model) {
        return CapState{model.elastic_volumetric_at(pressure, plastic_volumetric), plastic_volumetric, 0};
      },
      parameters_.modulus);
}

double TabularCap::plastic_volumetric_at_crush(double pressure) const
{
  const PiecewiseLinear& curve = parameters_.crush_curve;
  if (pressure <= curve.y().front()) return 0;
  const auto above = std::lower_bound(curve.y().begin(), curve.y().end(), pressure);
  const auto segment = std::min(static_cast<std::size_t>(above - curve.y().begin()), curve.n_segments()) - 1;
  return curve.x()[segment] + (pressure - curve.y()[segment]) / curve.slope_of_segment(segment);
}

namespace
{

/// A strain increment larger than this in one step is no step of a sound simulation, and is refused.
constexpr double largest_increment = 0.2;

/// Trial sqrt(J2) of s + 2 G e from the three products of s and e: they are all that a path needs of the tensors.
struct DeviatoricTrial {
  double old_j2, mixed, increment_j2;

  double sqrt_j2(double shear_modulus) const
  {
    return std::sqrt(std::max(old_j2 + 2 * shear_modulus * (mixed + 2 * shear_modulus * increment_j2), 0.0));
  }
};

/// The state form: pressure and modulus after plastic strain d are the surface's; G is the mean of both ends' of the
/// step (trapezoidal rule).
template <class Model>
struct StatePath {
  const Model& model;
  const PiecewiseLinear& crush_curve;
  DeviatoricTrial deviatoric;
  double elastic_trial, plastic_old, modulus_old, shear_ratio;

  PathPoint operator()(double d) const
  {
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

template <int D>
struct Particle {
  SymmetricTensor<D> deviator;  // of the stress
  double pressure;
  CapState state;
  double bulk_modulus;
  double plastic_work;
  double error;  // estimated, relative, summed over the substeps
  bool returned;
};

template <int D, class Model>
class Integrator
{
 public:
  Integrator(const TabularCap& sand, const Model& model)
      : yield_(sand.parameters().yield),
        crush_curve_(sand.parameters().crush_curve),
        model_(model),
        shear_ratio_(sand.shear_ratio()),
        tolerance_(sand.parameters().tolerance),
        max_substeps_(sand.parameters().max_substeps),
        form_(sand.parameters().elastic_update)
  {
  }

  Particle<D> start(const SymmetricTensor<D>& stress, const CapState& state) const
  {
    if (form_ == ElasticUpdate::state) {
      const ElasticPoint point = model_.at(state.elastic_volumetric, state.plastic_volumetric);
      return {deviator(stress), point.pressure, state, point.bulk_modulus, 0, 0, true};
    }
    const double pressure = -trace(stress) / 3;
    const double modulus = model_.bulk_modulus_at_pressure(pressure, state.plastic_volumetric);
    return {deviator(stress), pressure, state, modulus, 0, 0, true};
  }

  /// One step, in as many substeps as its error estimate asks for.
  Particle<D> advance(const Particle<D>& old, const SymmetricTensor<D>& strain_increment) const
  {
    Particle<D> now = substep(old, strain_increment);
    if (!(now.error <= tolerance_ && now.returned)) now = advance_cut(old, strain_increment, now);
    return now;
  }

 private:
  Particle<D> advance_cut(const Particle<D>& old, const SymmetricTensor<D>& strain_increment,
                          const Particle<D>& whole) const
  {
    const double wanted = whole.returned ? std::ceil(whole.error / tolerance_) : max_substeps_;
    const int n = wanted < max_substeps_ ? std::max(static_cast<int>(wanted), 2) : max_substeps_;
    Particle<D> particle = old;
    for (int i = 0; i < n && particle.returned; ++i) particle = substep(particle, strain_increment / n);
    return particle;
  }

  Particle<D> substep(const Particle<D>& old, const SymmetricTensor<D>& strain) const
  {
    const SymmetricTensor<D> e = deviator(strain);
    const double compaction = -trace(strain);
    const DeviatoricTrial deviatoric{0.5 * double_dot(old.deviator, old.deviator), double_dot(old.deviator, e),
                                     0.5 * double_dot(e, e)};
    if (form_ == ElasticUpdate::rate) {
      return after(old, e, compaction, deviatoric, rate_return(old, compaction, deviatoric));
    }
    const StatePath<Model> path{model_,
                                crush_curve_,
                                deviatoric,
                                old.state.elastic_volumetric + compaction,
                                old.state.plastic_volumetric,
                                old.bulk_modulus,
                                shear_ratio_};
    const PathPoint trial = path(0);
    if (inside(yield_, trial)) return after_elastic(old, e, compaction, deviatoric, trial);
    return after(old, e, compaction, deviatoric, return_to_surface(yield_, path, trial));
  }

  /// What `after` would give without a return, in less time: most particles of a step.
  Particle<D> after_elastic(const Particle<D>& old, const SymmetricTensor<D>& e, double compaction,
                            const DeviatoricTrial& deviatoric, const PathPoint& trial) const
  {
    CapState state = old.state;
    state.elastic_volumetric += compaction;
    const double error = modulus_error(old, trial.bulk_modulus, deviatoric, trial) /
                         error_scale(old, trial.pressure, trial.trial_sqrt_j2, trial);
    return {old.deviator + 2 * trial.shear_modulus * e,
            trial.pressure,
            state,
            trial.bulk_modulus,
            old.plastic_work,
            old.error + error,
            true};
  }

  /// Twice: with the modulus half way to the elastic trial, then with that of the mean of both ends.
  ReturnPoint rate_return(const Particle<D>& old, double compaction, const DeviatoricTrial& deviatoric) const
  {
    const double crush = crush_curve_(std::max(old.state.plastic_volumetric, 0.0));
    double pressure = std::min(old.pressure + 0.5 * old.bulk_modulus * compaction, std::max(crush, old.pressure));
    double plastic = old.state.plastic_volumetric;
    ReturnPoint point{};
    for (int pass = 0; pass < 2; ++pass) {
      const double modulus = model_.bulk_modulus_at_pressure(pressure, plastic);
      const double shear = shear_ratio_ * modulus;
      point =
          return_to_surface(yield_, RatePath{crush_curve_, old.pressure + modulus * compaction,
                                             old.state.plastic_volumetric, modulus, shear, deviatoric.sqrt_j2(shear)});
      pressure = 0.5 * (old.pressure + point.at.pressure);
      plastic = old.state.plastic_volumetric + 0.5 * point.plastic_volumetric;
    }
    return point;
  }

  Particle<D> after(const Particle<D>& old, const SymmetricTensor<D>& e, double compaction,
                    const DeviatoricTrial& deviatoric, const ReturnPoint& point) const
  {
    const double d = point.plastic_volumetric, trial = point.at.trial_sqrt_j2;
    const SymmetricTensor<D> trial_deviator = old.deviator + 2 * point.at.shear_modulus * e;
    Particle<D> now;
    now.deviator = trial > 0 ? SymmetricTensor<D>(trial_deviator * (point.sqrt_j2 / trial)) : trial_deviator;
    now.pressure = point.at.pressure;
    now.state = {old.state.elastic_volumetric + compaction - d, old.state.plastic_volumetric + d,
                 old.state.equivalent_plastic + point.multiplier / std::numbers::sqrt3};
    now.bulk_modulus = form_ == ElasticUpdate::state
                           ? point.at.bulk_modulus
                           : model_.bulk_modulus_at_pressure(now.pressure, now.state.plastic_volumetric);
    now.plastic_work = old.plastic_work + 0.5 * (old.pressure + now.pressure) * d;
    if (point.multiplier > 0 && trial > 0) {
      // The plastic strain's deviator is dl s / (2 sqrt(J2)), along the trial.
      const double along = double_dot(old.deviator, trial_deviator) + double_dot(now.deviator, trial_deviator);
      now.plastic_work += 0.25 * along * point.multiplier / trial;
    }
    now.error = old.error + error(old, now, deviatoric, point);
    now.returned = point.status != ReturnStatus::failed && std::isfinite(now.pressure) && std::isfinite(point.sqrt_j2);
    return now;
  }

  double error_scale(const Particle<D>& old, double pressure, double sqrt_j2, const PathPoint& at) const
  {
    return std::max(std::max(old.pressure, pressure), std::max(sqrt_j2, 0.1 * at.crush_pressure));
  }

  /// Of the trapezoidal rule in the modulus, in the deviator: Pa.
  double modulus_error(const Particle<D>& old, double bulk_modulus, const DeviatoricTrial& deviatoric,
                       const PathPoint& at) const
  {
    const double change = (bulk_modulus - old.bulk_modulus) / (bulk_modulus + old.bulk_modulus);
    return change * change * 2 * at.shear_modulus * std::sqrt(deviatoric.increment_j2);
  }

  /// Estimated stress error, relative: of the trapezoidal rule in the modulus, and of a flow direction taken at the
  /// step's end (backward Euler), which is half its turning times the stress it takes off.
  double error(const Particle<D>& old, const Particle<D>& now, const DeviatoricTrial& deviatoric,
               const ReturnPoint& point) const
  {
    const double shear = point.at.shear_modulus;
    const double scale = error_scale(old, now.pressure, point.sqrt_j2, point.at);
    double stress = modulus_error(old, now.bulk_modulus, deviatoric, point.at);
    if (form_ == ElasticUpdate::rate) {
      const double change = (now.bulk_modulus - old.bulk_modulus) / (now.bulk_modulus + old.bulk_modulus);
      stress += change * change * std::abs(now.pressure - old.pressure + now.bulk_modulus * point.plastic_volumetric);
    }
    if (point.status == ReturnStatus::cone_or_cap) {
      const double returned = point.at.bulk_modulus * std::abs(point.plastic_volumetric) + shear * point.multiplier;
      // Half a turning is at most 1, and there are two: often that is enough to know.
      if (stress + 2 * returned <= tolerance_ * scale) return (stress + 2 * returned) / scale;
      const double old_crush = crush_curve_(std::max(old.state.plastic_volumetric, 0.0));
      const double turn =
          distance(normal(old.pressure, old_crush, point), normal(now.pressure, point.at.crush_pressure, point));
      stress += 0.5 * turn * returned;
      // The stress deviator turns too, and the flow with it: |s' - s| of unit s from the cosine between them.
      const double trial = point.at.trial_sqrt_j2, both = 2 * std::sqrt(deviatoric.old_j2) * trial;
      if (both > 0) {
        const double cosine = (2 * deviatoric.old_j2 + 2 * shear * deviatoric.mixed) / both;
        stress += 0.5 * std::sqrt(std::max(2 - 2 * cosine, 0.0)) * shear * point.multiplier;
      }
    }
    return stress / scale;
  }

  struct Direction {
    double volumetric, deviatoric;
  };

  /// The surface's normal at a pressure, of unit length in the norm of the elastic energy.
  Direction normal(double pressure, double crush_pressure, const ReturnPoint& point) const
  {
    const YieldSurface::Strength g = yield_.strength(pressure);
    const YieldSurface::Cap cap = yield_.cap(pressure, crush_pressure);
    const double slope_sine = g.slope * cap.sine * cap.sine - g.value * std::min(cap.rho, 1.0) / cap.half_axis;
    const double volumetric = slope_sine * std::sqrt(point.at.bulk_modulus);
    const double deviatoric = cap.sine * std::sqrt(point.at.shear_modulus);
    const double length = std::sqrt(volumetric * volumetric + deviatoric * deviatoric);
    return {volumetric / length, deviatoric / length};
  }

  static double distance(const Direction& a, const Direction& b)
  {
    const double volumetric = a.volumetric - b.volumetric, deviatoric = a.deviatoric - b.deviatoric;
    return std::sqrt(volumetric * volumetric + deviatoric * deviatoric);
  }

  const YieldSurface& yield_;
  const PiecewiseLinear& crush_curve_;
  const Model& model_;
  double shear_ratio_, tolerance_;
  int max_substeps_;
  ElasticUpdate form_;
};

/// Why a particle cannot be updated by this increment; empty if nothing speaks against it.
template <int D>
std::string objection(const SymmetricTensor<D>& strain, const SymmetricTensor<D>& stress, const CapState& state)
{
  // A sum is finite if its terms are (and a sum that overflows is no better).
  const double sum = strain.sum() + stress.sum() + state.elastic_volumetric + state.plastic_volumetric;
  if (!std::isfinite(sum)) return "its strain increment, stress or state is not finite";
  const double size = double_dot(strain, strain);
  if (size <= largest_increment * largest_increment) return {};
  return "a strain increment of size " + std::to_string(std::sqrt(size)) + " in one step, more than " +
         std::to_string(largest_increment);
}

}  // namespace

template <int D>
std::optional<UpdateFailure> update(const TabularCap& sand, std::span<const SymmetricTensor<D>> strain_increment,
                                    std::span<const CapState> state_old, std::span<SymmetricTensor<D>> stress,
                                    std::span<CapState> state, std::span<double> bulk_modulus,
                                    std::span<double> plastic_work)
{
  return std::visit(
      [&]<class Model>(const Model& model) -> std::optional<UpdateFailure> {
        const Integrator<D, Model> integrator(sand, model);
        for (std::size_t i = 0; i < strain_increment.size(); ++i) {
          if (std::string reason = objection<D>(strain_increment[i], stress[i], state_old[i]); !reason.empty()) {
            return UpdateFailure{i, std::move(reason)};
          }
          const Particle<D> now = integrator.advance(integrator.start(stress[i], state_old[i]), strain_increment[i]);
          if (!now.returned) return UpdateFailure{i, "no stress on the yield surface was found"};
          stress[i] = now.deviator - isotropic<n_symmetric<D>>(now.pressure);
          state[i] = now.state;
          bulk_modulus[i] = now.bulk_modulus;
          plastic_work[i] = now.plastic_work;
        }
        return std::nullopt;
      },
      sand.parameters().modulus);
}

template std::optional<UpdateFailure> update<2>(const TabularCap&, std::span<const SymmetricTensor<2>>,
                                                std::span<const CapState>, std::span<SymmetricTensor<2>>,
                                                std::span<CapState>, std::span<double>, std::span<double>);
template std::optional<UpdateFailure> update<3>(const TabularCap&, std::span<const SymmetricTensor<3>>,
                                                std::span<const CapState>, std::span<SymmetricTensor<3>>,
                                                std::span<CapState>, std::span<double>, std::span<double>);

}  // namespace tamp::components
