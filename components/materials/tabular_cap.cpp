#include "components/materials/tabular_cap.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "components/materials/cap_tile.hpp"
#include "components/materials/gaps.hpp"
#include "components/materials/separation.hpp"
#include "components/tensor_lanes.hpp"

namespace tamp::components
{

TabularCap::TabularCap(TabularCapParameters parameters) : parameters_(std::move(parameters))
{
  const double nu = parameters_.poisson_ratio;
  if (!(nu > -1 && nu < 0.5)) throw BadValue("Poisson's ratio " + std::to_string(nu), "a number between -1 and 0.5");
  shear_ratio_ = 1.5 * (1 - 2 * nu) / (1 + nu);
  least_plastic_ = std::visit([](const auto& model) { return model.range().least_plastic; }, parameters_.modulus);

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
  if (const auto part = parameters_.separation_density; part && !(*part > 0 && *part <= 1)) {
    throw BadValue("a part of " + std::to_string(*part) + " of the density", "one above 0 and up to 1");
  }
  if (const auto limit = parameters_.dilation_limit; limit && !(*limit >= 0)) {
    throw BadValue("a greatest expansion of " + std::to_string(*limit), "0 or more");
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
                   : model.rate_modulus(pressure, state.elastic_volumetric, state.plastic_volumetric);
      },
      parameters_.modulus);
}

TangentModuli TabularCap::initial_moduli() const
{
  const double bulk = bulk_modulus({}, 0);
  return {bulk, shear_ratio_ * bulk};
}

Tested TabularCap::tested(const CapState& state, double pressure) const
{
  if (pressure < 0 || state.separation_volume > 0) return Tested::within;
  const double elastic = state.elastic_volumetric, plastic = state.plastic_volumetric;
  const bool rate = parameters_.elastic_update == ElasticUpdate::rate;
  const bool is_within = std::visit(
      [&](const auto& model) {
        return rate ? model.rate_in_range(pressure, elastic, plastic) : model.in_range(elastic, plastic);
      },
      parameters_.modulus);
  if (is_within) return Tested::within;
  return plastic < least_plastic_ ? Tested::looser : Tested::beyond;
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
        return CapState{.elastic_volumetric = elastic_volumetric_at(model, pressure, plastic_volumetric),
                        .plastic_volumetric = plastic_volumetric};
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

CapState TabularCap::settled_state(const SettledStress& settled) const
{
  const Invariants now = invariants(settled.stress);
  const double plastic = plastic_volumetric_at_crush(settled.greatest);
  check_is_borne(now, parameters_.yield.limit(now.pressure, crush_pressure(plastic)));
  return state_at_pressure(now.pressure, plastic);
}

namespace
{

double in_range(const TabularCap& sand, const CapState& state, const Invariants&)
{
  return std::visit(
      [&](const auto& model) { return model.in_range(state.elastic_volumetric, state.plastic_volumetric) ? 1.0 : 0.0; },
      sand.parameters().modulus);
}

/// Tangent bulk modulus of the last update [Pa]; before the first, that of the particle's initial state.
double tangent_bulk_modulus(const TabularCap& sand, const CapState& state, const Invariants& stress)
{
  const bool is_fresh = state.bulk_modulus == 0 && state.separation_volume == 0;
  return is_fresh ? sand.bulk_modulus(state, stress.pressure) : state.bulk_modulus;
}

double outside(const TabularCap& sand, const CapState& state, const Invariants& stress)
{
  const YieldSurface& surface = sand.parameters().yield;
  const double p = stress.pressure, vertex = surface.vertex_pressure();
  const double crush = sand.crush_pressure(state.plastic_volumetric);
  return std::max({stress.sqrt_j2() - surface.limit(p, crush), p - crush, vertex - p, 0.0}) / (crush - vertex);
}

constexpr std::array<StateColumn<TabularCap>, 8> cap_columns{{
    {"elastic_volumetric", "-", [](const auto&, const CapState& s, const auto&) { return s.elastic_volumetric; }},
    {"plastic_volumetric", "-", [](const auto&, const CapState& s, const auto&) { return s.plastic_volumetric; }},
    {"cap", "Pa",
     [](const auto& sand, const CapState& s, const auto&) { return sand.crush_pressure(s.plastic_volumetric); }},
    {"K", "Pa", tangent_bulk_modulus, Shown::in_field_files},
    {"failed_updates", "",
     [](const auto&, const CapState& s, const auto&) { return static_cast<double>(s.n_failures); },
     Shown::in_field_files},
    {"apart", "", [](const auto&, const CapState& s, const auto&) { return s.separation_volume > 0 ? 1.0 : 0.0; },
     Shown::in_field_files, [](const TabularCap& sand) { return sand.may_separate(); }},
    {"in_range", "", in_range, Shown::by_drive},
    {"outside", "-", outside, Shown::by_drive},
}};
constexpr std::array<StateExtreme, 3> cap_extremes{{{.column = 2}, {.column = 1}, {.column = 1, .greatest = false}}};

/// A strain increment larger than this in one step is no step of a sound simulation, and is refused.
constexpr double largest_increment = 0.2;

}  // namespace

std::span<const StateColumn<TabularCap>, 8> TabularCap::columns()
{
  return cap_columns;
}

std::span<const StateExtreme, 3> TabularCap::extremes()
{
  return cap_extremes;
}

namespace
{

/// A batch on its way through a tile.
template <int D, class Model>
class CapBatch
{
 public:
  CapBatch(const TabularCap& sand, const Model& model, const MaterialBatch<D, CapState>& batch)
      : sand_(sand),
        model_(model),
        batch_(batch),
        may_part_(sand.may_separate()),
        integrator_(sand, model),
        tile_(integrator_)
  {
  }

  BatchFailure update(UpdateCounts& counts)
  {
    for (std::size_t first = 0; first < batch_.stress.size(); first += tile_.size) {
      const std::size_t n = std::min(tile_.size, batch_.stress.size() - first);
      for (std::size_t i = 0; i < n; i += n_lanes) load_lanes(first, i, std::min(n_lanes, n - i));
      tile_.advance();
      for (std::size_t i = 0; i < n; i += n_lanes) store_lanes(first, i, std::min(n_lanes, n - i));
    }
    counts.add(counts_);
    counts.add(integrator_.counts());
    return failure_;
  }

 private:
  using Tensors = SymmetricTensor<D, Lanes>;

  /// The n particles from number `i` of the tile on, which begins with particle `first`.
  void load_lanes(std::size_t first, std::size_t i, std::size_t n)
  {
    const std::size_t begin = first + i;
    const Gaps parted = parted_of(begin, n);
    const Tensors increment = lanes_at(batch_.strain_increment, begin), stress = lanes_at(batch_.stress, begin);
    const Tensors strain = of_solid(increment, parted);
    std::array<const double*, n_lanes> states;
    for (std::size_t l = 0; l < n_lanes; ++l) states[l] = &old_state(begin, n, l).elastic_volumetric;
    const auto [elastic_volumetric, plastic_volumetric, equivalent_plastic, bulk_modulus] = side_by_side<4>(states);
    const Tensors e = deviator(strain), s = deviator(stress);
    const Lanes e_j2 = 0.5 * double_dot(e, e), pressure = trace(stress) / -3.0;
    CapParticleOf<Lanes> particles{.pressure = pressure,
                                   .j2 = 0.5 * double_dot(s, s),
                                   .mixed = double_dot(s, e),
                                   .elastic_volumetric = elastic_volumetric,
                                   .plastic_volumetric = plastic_volumetric,
                                   .equivalent_plastic = equivalent_plastic,
                                   .bulk_modulus = bulk_modulus};
    const Mask<Lanes> fresh = !parted.still && !(particles.bulk_modulus > 0.0);
    if (any(fresh)) {
      particles.bulk_modulus = select(fresh, modulus(particles), particles.bulk_modulus);
      counts_.modulus_evaluations += count(fresh && first_lanes(n));
    }
    // A sum is finite if its terms are, and one that overflows is no better.
    const Lanes sum = increment.sum() + stress.sum() + particles.elastic_volumetric + particles.plastic_volumetric;
    const Mask<Lanes> sound = is_finite(sum) && double_dot(strain, strain) <= largest_increment * largest_increment;
    tile_.put(i, n, particles, {-trace(strain), e_j2, sqrt(e_j2)}, sound && !parted.still);
  }

  /// The old state of lane l of the n particles from `begin` on; lanes beyond them repeat the last.
  const CapState& old_state(std::size_t begin, std::size_t n, std::size_t l) const
  {
    return batch_.old_state[begin + std::min(l, n - 1)];
  }

  /// Which particles were apart when the step started, which still are when it ends, and what becomes of their gaps.
  Gaps parted_of(std::size_t begin, std::size_t n) const
  {
    if (!may_part_) return {};
    if (sand_.keeps_gaps()) {
      return {lanes_at(batch_.old_opening, begin), trace(lanes_at(batch_.strain_increment, begin))};
    }
    const Lanes parted_at =
        each_lane([&](std::size_t l) -> double { return old_state(begin, n, l).separation_volume; });
    Gaps gaps;
    gaps.before = parted_at > 0.0;
    if (!any(gaps.before)) return gaps;
    const Lanes volume = each_lane([&](std::size_t l) { return volume_of(begin + std::min(l, n - 1)); });
    gaps.still = gaps.before && volume >= parted_at;
    gaps.compaction = select(gaps.before, compaction_beyond(parted_at, volume), Lanes(0.0));
    return gaps;
  }

  /// Volume of a particle over that at the start.
  double volume_of(std::size_t i) const
  {
    const double in_plane = batch_.deformation_gradient[i].determinant();
    return batch_.hoop_stretch.empty() ? in_plane : in_plane * batch_.hoop_stretch[i];
  }

  /// The strain of particles that were whole.
  Tensors of_solid(Tensors strain, const Gaps& parted) const
  {
    if (!may_part_) return strain;
    for (int k = 0; k < n_symmetric<D>; ++k) strain[k] = select(parted.before, Lanes(0.0), strain[k]);
    return strain;
  }

  Lanes modulus(const CapParticleOf<Lanes>& at) const
  {
    return sand_.parameters().elastic_update == ElasticUpdate::state
               ? model_.at(at.elastic_volumetric, at.plastic_volumetric).bulk_modulus
               : model_.rate_modulus(at.pressure, at.elastic_volumetric, at.plastic_volumetric);
  }

  void store_lanes(std::size_t first, std::size_t i, std::size_t n)
  {
    const std::size_t begin = first + i;
    const auto [now, error] = tile_.lanes_at(i);
    const Gaps parted = parted_of(begin, n);
    const Mask<Lanes> found = is_finite(error), within = is_in_range(now) || parted.still;
    const Tensors e = deviator(of_solid(lanes_at(batch_.strain_increment, begin), parted));
    const Tensors old = lanes_at(batch_.stress, begin), s = deviator(old);
    Tensors stress = now.of_stress * s + now.of_strain * e;
    for (int k = 0; k < n_symmetric<D>; ++k) {
      stress[k] = select(found, k < 3 ? stress[k] - now.pressure : stress[k], old[k]);
    }
    set_lanes(batch_.stress, begin, stress);
    set_lanes(batch_.bulk_modulus, begin, now.bulk_modulus);
    set_lanes(batch_.shear_modulus, begin, sand_.shear_ratio() * now.bulk_modulus);
    set_lanes(batch_.plastic_work, begin, now.plastic_work);
    counts_.with_range += n;
    if (!all_of(within)) count_extrapolated(now, !within && first_lanes(n));
    if (!may_part_ && all_of(found)) return set_states(begin, n, now);
    for (std::size_t l = 0; l < n; ++l) {
      if (found[l]) {
        set_state(begin + l, now, parted, l);
      } else if (may_part_ && parted.still[l]) {
        stay_apart(begin + l, parted.opening[l]);
      } else {
        fail(begin + l);
      }
    }
  }

  /// Sets the states of the n particles from `begin` on, all of which found a stress.
  void set_states(std::size_t begin, std::size_t n, const CapParticleOf<Lanes>& now)
  {
    std::array<double*, n_lanes> states;
    for (std::size_t l = 0; l < n_lanes; ++l) {
      const std::size_t i = begin + std::min(l, n - 1);
      batch_.state[i].n_failures = batch_.old_state[i].n_failures;
      batch_.state[i].separation_volume = 0;
      states[l] = &batch_.state[i].elastic_volumetric;
    }
    set_side_by_side<4>({now.elastic_volumetric, now.plastic_volumetric, now.equivalent_plastic, now.bulk_modulus},
                        states, n);
  }

  /// Sets the state of particle i, which found the stress of lane l. It may have joined, or be torn now.
  void set_state(std::size_t i, const CapParticleOf<Lanes>& now, const Gaps& parted, std::size_t l)
  {
    const CapState old = batch_.old_state[i];
    batch_.state[i] = {now.elastic_volumetric[l], now.plastic_volumetric[l], now.equivalent_plastic[l],
                       now.bulk_modulus[l], old.n_failures};
    if (!may_part_) return;
    set_opening(i, 0);
    if (parted.before[l]) {
      batch_.state[i].plastic_volumetric += parted.compaction[l];
    } else if (is_torn(sand_, now.pressure[l], now.j2[l]) && is_light(sand_, volume_of(i))) {
      part(i, now.pressure[l], old.plastic_volumetric);
    }
  }

  void set_opening(std::size_t i, double opening)
  {
    if (sand_.keeps_gaps()) batch_.opening[i] = opening;
  }

  /// Keeps the particle apart; the tile has left its stress, its moduli and its plastic work at zero.
  void stay_apart(std::size_t i, double opening)
  {
    batch_.state[i] = batch_.old_state[i];
    set_opening(i, opening);
    ++counts_.apart;
  }

  /// Separates the particle. With gaps, its stretch beyond the vertex becomes a gap, and its plastic volume stays as it
  /// was.
  void part(std::size_t i, double pressure, double old_plastic)
  {
    CapState& state = batch_.state[i];
    if (sand_.keeps_gaps()) {
      const double opening = old_plastic - state.plastic_volumetric;
      if (!(opening > 0)) return;
      set_opening(i, opening);
      state.plastic_volumetric = old_plastic;
    }
    const double released = energy_of_parting(pressure, state.bulk_modulus, trace(batch_.strain_increment[i]));
    batch_.plastic_work[i] = std::max(batch_.plastic_work[i] + released, 0.0);
    state.elastic_volumetric = state.bulk_modulus = 0;
    // Rounded down, so that it does not join while it rests.
    state.separation_volume = static_cast<float>((1 - 1e-7) * volume_of(i));
    batch_.stress[i].setZero();
    batch_.bulk_modulus[i] = batch_.shear_modulus[i] = 0;
    ++counts_.separations;
  }

  Mask<Lanes> is_in_range(const CapParticleOf<Lanes>& at) const
  {
    return sand_.parameters().elastic_update == ElasticUpdate::state
               ? in_range(model_, at.elastic_volumetric, at.plastic_volumetric)
               : rate_in_range(model_, at.pressure, at.elastic_volumetric, at.plastic_volumetric);
  }

  void count_extrapolated(const CapParticleOf<Lanes>& now, const Mask<Lanes>& outside)
  {
    const Mask<Lanes> pulled = now.pressure < 0.0;
    counts_.extrapolated += count(outside);
    counts_.pulled_out += count(outside && pulled);
    counts_.looser += count(outside && !pulled && now.plastic_volumetric < sand_.least_plastic());
  }

  /// Leaves the particle as it was, and marks it.
  void fail(std::size_t i)
  {
    const CapState& old = batch_.old_state[i];
    if (!failure_) failure_ = UpdateFailure{i, fault_of(i)};
    ++counts_.failures;
    const double last = old.bulk_modulus, bulk = last > 0 ? last : sand_.initial_moduli().bulk_modulus;
    batch_.state[i] = old;
    ++batch_.state[i].n_failures;
    batch_.bulk_modulus[i] = bulk;
    batch_.shear_modulus[i] = sand_.shear_ratio() * bulk;
    batch_.plastic_work[i] = 0;
    if (sand_.keeps_gaps()) batch_.opening[i] = batch_.old_opening[i];
  }

  UpdateFault fault_of(std::size_t i) const
  {
    const SymmetricTensor<D>& strain = batch_.strain_increment[i];
    const CapState& old = batch_.old_state[i];
    const double sum = strain.sum() + batch_.stress[i].sum() + old.elastic_volumetric + old.plastic_volumetric;
    if (!std::isfinite(sum)) return UpdateFault::not_finite;
    return double_dot(strain, strain) <= largest_increment * largest_increment ? UpdateFault::no_return
                                                                               : UpdateFault::too_large;
  }

  const TabularCap& sand_;
  const Model& model_;
  const MaterialBatch<D, CapState>& batch_;
  bool may_part_;
  CapIntegrator<Model> integrator_;
  CapTile<Model> tile_;
  UpdateCounts counts_;
  BatchFailure failure_;
};

}  // namespace

template <int D>
BatchFailure update(const TabularCap& sand, const MaterialBatch<D, CapState>& batch, UpdateCounts& counts)
{
  return std::visit([&](const auto& model) { return CapBatch(sand, model, batch).update(counts); },
                    sand.parameters().modulus);
}

template BatchFailure update<2>(const TabularCap&, const MaterialBatch<2, CapState>&, UpdateCounts&);
template BatchFailure update<3>(const TabularCap&, const MaterialBatch<3, CapState>&, UpdateCounts&);

}  // namespace tamp::components
