#include "components/materials/bolton_sand.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "components/errors.hpp"
#include "components/materials/mohr_coulomb_return.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

constexpr double atmosphere = 100e3;        // Pa
constexpr double least_logged = 150;        // kPa: tests below have no more dilation (Bolton 1986)
constexpr double most_index = 4;            // of I_R, likewise
constexpr double dilation_per_index = 0.3;  // D / I_R
constexpr double degree = std::numbers::pi / 180;

template <class Number>
Number void_ratio_of(const BoltonSand& sand, const Number& plastic_volumetric)
{
  return (1 + sand.initial_void_ratio) * portable::exp(-plastic_volumetric) - 1.0;
}

template <class Number>
Number index_of(const BoltonSand& sand, const Number& void_ratio, const Number& pressure)
{
  const Number relative_density = (sand.e_max - void_ratio) / (sand.e_max - sand.e_min);
  return relative_density * (sand.Q - portable::log(greater_of<Number>(1e-3 * pressure, least_logged))) - sand.R;
}

/// K = k sqrt(p) above a least pressure, and constant below.
template <class Number>
class PressureLaw
{
 public:
  PressureLaw(const BoltonSand& sand, const Number& void_ratio)
      : least_(sand.stiffness_floor), root_of_least_(std::sqrt(sand.stiffness_floor))
  {
    const double nu = sand.poissons_ratio, bulk_by_shear = 2 * (1 + nu) / (3 * (1 - 2 * nu));
    const Number room = 2.97 - void_ratio;
    k_ = bulk_by_shear * sand.shear_modulus_number * std::sqrt(atmosphere) * room * room / (1.0 + void_ratio);
  }

  Number bulk_modulus(const Number& pressure) const { return k_ * sqrt(greater_of<Number>(pressure, least_)); }

  /// The pressure after a volumetric compaction without plastic strain: that integral of K, to the bit the same without
  /// compaction, so that round-off does not tear sand without pressure.
  Number pressure_after(const Number& pressure, const Number& compaction) const
  {
    const Number root = sqrt(greater_of<Number>(pressure, least_)), rise = k_ * compaction;
    const Number above = pressure + rise * (root + 0.25 * rise), below = pressure + rise * root_of_least_;
    // Through the least pressure: the rest of the way by the other law.
    const Number risen = rise - (least_ - pressure) / root_of_least_;
    const Number upwards = least_ + risen * (root_of_least_ + 0.25 * risen);
    const Number downwards = least_ + (rise + 2.0 * (root - root_of_least_)) * root_of_least_;
    return select(pressure > least_, select(root + 0.5 * rise >= root_of_least_, above, downwards),
                  select(below <= least_, below, upwards));
  }

 private:
  double least_, root_of_least_;
  Number k_;
};

double shear_by_bulk(const BoltonSand& sand)
{
  return 1.5 * (1 - 2 * sand.poissons_ratio) / (1 + sand.poissons_ratio);
}

/// The response of the sand, see SoilBatch.
class BoltonResponse
{
 public:
  explicit BoltonResponse(const BoltonSand& sand)
      : sand_(sand), shear_by_bulk_(shear_by_bulk(sand)), crushing_pressure_(sand.crushing_pressure())
  {
  }

  /// The strain's secant modulus gives the shear modulus of the step.
  template <int D>
  SoilTrial<D> trial(const SymmetricTensor<D, Lanes>& old, const SymmetricTensor<D, Lanes>& strain,
                     const SoilStateOf<Lanes>& state) const
  {
    const PressureLaw<Lanes> law(sand_, void_ratio_of(sand_, state.plastic_volumetric));
    const Lanes compaction = -trace(strain), pressure = trace(old) / -3.0;
    const Lanes after = law.pressure_after(pressure, compaction);
    constexpr double no_strain = 1e-12;
    const Mask<Lanes> strains = abs(compaction) > no_strain;
    const Lanes bulk =
        select(strains, (after - pressure) / select(strains, compaction, Lanes(1.0)), law.bulk_modulus(pressure));
    const ModuliOf<Lanes> moduli{bulk, shear_by_bulk_ * bulk};
    return {
        deviator(old) + Lanes(2.0 * moduli.shear_modulus) * deviator(strain) - isotropic<n_symmetric<D>, Lanes>(after),
        moduli, pressure};
  }

  template <int D>
  SoilReturn<D> returned(const SoilTrial<D>& trial, const SoilStateOf<Lanes>& state) const
  {
    const Lanes index = index_of<Lanes>(sand_, void_ratio_of(sand_, state.plastic_volumetric), trial.old_pressure);
    const Lanes angle =
        degree * (sand_.critical_friction_angle + sand_.strength_per_index * clamped<Lanes>(index, 0.0, most_index));
    const Lanes dilation = dilation_per_index * clamped<Lanes>(index, -sand_.R, most_index);
    const Lanes sin_friction = portable::cos(0.5 * std::numbers::pi - angle);
    return returned_to<D>({sin_friction, dilation / (2.0 + dilation), 0.0, 0.0}, trial);
  }

  ModuliOf<Lanes> stiffness(const SoilStateOf<Lanes>& state, const Lanes& pressure) const
  {
    const Lanes bulk = PressureLaw<Lanes>(sand_, void_ratio_of(sand_, state.plastic_volumetric)).bulk_modulus(pressure);
    return {bulk, shear_by_bulk_ * bulk};
  }

  Mask<Lanes> is_beyond(const Lanes& pressure) const { return pressure > crushing_pressure_; }

 private:
  const BoltonSand& sand_;
  double shear_by_bulk_, crushing_pressure_;
};

constexpr Range void_ratios{.lower = 0, .upper = 2.97, .holds_lower = false, .holds_upper = false};
constexpr std::array<Parameter<BoltonSand>, 11> bolton_parameters{{
    {"grain_density", "kg/m^3", above_zero, &BoltonSand::grain_density,
     "of the grains; with `density` it gives the void ratio, which lies from `e_min` to `e_max`"},
    {"e_min", "", void_ratios, &BoltonSand::e_min, "void ratio of the densest packing"},
    {"e_max", "", void_ratios, &BoltonSand::e_max, "void ratio of the loosest packing"},
    {"critical_friction_angle",
     "degrees",
     {.lower = 20, .upper = 45},
     &BoltonSand::critical_friction_angle,
     "of shear at constant volume"},
    {"shear_modulus_number", "", above_zero, &BoltonSand::shear_modulus_number,
     "g in G = g p_a (2.97 - e)^2 / (1 + e) sqrt(p / p_a), p_a = 100 kPa: 125 for Toyoura sand"},
    {"poisson_ratio",
     "",
     {.lower = -1, .upper = 0.5, .holds_lower = false, .holds_upper = false},
     &BoltonSand::poissons_ratio,
     "gives the bulk modulus from the shear modulus"},
    {"Q", "", above_zero, &BoltonSand::Q, "by which dilation ends at the pressure exp(Q) kPa; 10 for quartz", true},
    {"R", "", zero_or_above, &BoltonSand::R, "1 by Bolton's tests", true},
    {"strength_per_index", "degrees", zero_or_above, &BoltonSand::strength_per_index,
     "m, by which the friction angle grows with I_R; without it Bolton's: 5 in plane strain, else 3", true},
    {"stiffness_floor", "Pa", above_zero, &BoltonSand::stiffness_floor,
     "pressure below which the moduli fall no further", true},
    {"separation", "", any_number, &BoltonSand::separation,
     "whether grains part where there is no pressure, and bear and resist nothing until the gaps have closed, see "
     "[sand.md](../explanation/sand.md#sand-that-separates)",
     true},
}};

constexpr std::array<StateColumn<BoltonSand>, 4> bolton_columns{{
    soil_columns<BoltonSand>[0],
    soil_columns<BoltonSand>[1],
    {
      "void_ratio", "-",
          [](const BoltonSand& sand, const SoilState& s, const Invariants&) { return sand.void_ratio(s); }
    },
    {
      "dilatancy_index", "-", [](const BoltonSand& sand, const SoilState& s, const Invariants& stress) {
        return sand.dilatancy_index(s, stress.pressure);
      }
    },
}};

}  // namespace

std::span<const Parameter<BoltonSand>, 11> BoltonSand::parameters()
{
  return bolton_parameters;
}

std::span<const StateColumn<BoltonSand>, 4> BoltonSand::columns()
{
  return bolton_columns;
}

std::span<const StateExtreme, 3> BoltonSand::extremes()
{
  return soil_extremes;
}

TangentModuli BoltonSand::initial_moduli() const
{
  const double bulk = bulk_modulus({}, 0);
  return {bulk, shear_by_bulk(*this) * bulk};
}

void BoltonSand::check() const
{
  if (e_min >= e_max) {
    throw BadParameter("e_min", fmt::format("{}", e_min), fmt::format("below e_max, {}", e_max));
  }
}

void BoltonSand::fill(double density)
{
  initial_void_ratio = grain_density / density - 1;
  constexpr double round_off = 1e-9;
  if (initial_void_ratio >= e_min - round_off && initial_void_ratio <= e_max + round_off) return;
  throw BadParameter("density", fmt::format("{}, a void ratio of {:.4g}", density, initial_void_ratio),
                     fmt::format("{:.5g} to {:.5g} kg/m^3: from e_max {} to e_min {}", grain_density / (1 + e_max),
                                 grain_density / (1 + e_min), e_max, e_min));
}

void BoltonSand::choose_strength(bool in_plane_strain)
{
  if (std::isfinite(strength_per_index)) return;
  strength_per_index = in_plane_strain ? strength_in_plane_strain : strength_in_triaxial_compression;
}

SoilState BoltonSand::settled_state(const SettledStress& settled) const
{
  const double pressure = invariants(settled.stress).pressure;
  check_tension(pressure, 0);
  const double index = std::clamp(dilatancy_index({}, pressure), 0.0, most_index);
  check_is_borne(settled, portable::sin(degree * (critical_friction_angle + strength_per_index * index)), 0);
  return {};
}

double BoltonSand::bulk_modulus(const SoilState& state, double pressure) const
{
  return PressureLaw<double>(*this, void_ratio(state)).bulk_modulus(pressure);
}

double BoltonSand::crushing_pressure() const
{
  return 1e3 * portable::exp(Q - R);
}

Tested BoltonSand::tested(const SoilState& /*state*/, double pressure) const
{
  return pressure > crushing_pressure() ? Tested::beyond : Tested::within;
}

double BoltonSand::void_ratio(const SoilState& state) const
{
  return void_ratio_of(*this, state.plastic_volumetric);
}

double BoltonSand::dilatancy_index(const SoilState& state, double pressure) const
{
  return index_of(*this, void_ratio(state), pressure);
}

template <int D>
BatchFailure update(const BoltonSand& sand, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts)
{
  return SoilBatch<D, BoltonResponse>(BoltonResponse(sand), batch, counts).update();
}

template BatchFailure update<2>(const BoltonSand&, const MaterialBatch<2, SoilState>&, UpdateCounts&);
template BatchFailure update<3>(const BoltonSand&, const MaterialBatch<3, SoilState>&, UpdateCounts&);

}  // namespace tamp::components
