#pragma once

#include <limits>
#include <span>
#include <string_view>

#include "components/materials/material_batch.hpp"
#include "components/materials/settled_start.hpp"
#include "components/materials/soil_state.hpp"
#include "components/parameter.hpp"

namespace tamp::components
{

/// Dry sand whose strength and dilation follow from its density and pressure (M. D. Bolton, The strength and dilatancy
/// of sands, Geotechnique 36, 1986), by the relative dilatancy index
///
///     I_R = I_D (Q - ln p) - R,   I_D = (e_max - e) / (e_max - e_min),
///
/// p in kPa, compression positive, and not below 150. Strength is Mohr and Coulomb's, phi = phi_cs + m I_R, with I_R
/// between 0 and 4; flow is by D = -d(eps_v) / d(eps_1) = 0.3 I_R up to 4, sin(psi) = D / (2 + D). Below I_R = 0 shear
/// compacts by the same rule, down to what I_D = 0 has: an extrapolation of ours. The void ratio e follows the plastic
/// volume, so that loose and dense sand meet where I_R is 0. There is no crushing: see docs/how_to/which_sand.md for
/// the pressures.
///
/// Moduli are isotropic, of constant Poisson's ratio,
///
///     G = g p_a (2.97 - e)^2 / (1 + e) sqrt(p / p_a),   p_a = 100 kPa,
///
/// (F. E. Richart, J. R. Hall and R. D. Woods, Vibrations of Soils and Foundations, Prentice-Hall 1970), not below
/// those at a least pressure; the pressure of a step is integrated exactly.
struct BoltonSand {
  using State = SoilState;
  static constexpr std::string_view type = "bolton_sand";
  static constexpr bool is_soil = true;
  static constexpr char state_name[] = "bolton sand state";
  static constexpr double strength_in_plane_strain = 5, strength_in_triaxial_compression = 3;  ///< degrees per I_R
  static std::span<const Parameter<BoltonSand>, 11> parameters();
  static std::span<const StateColumn<BoltonSand>, 4> columns();
  static std::span<const StateExtreme, 3> extremes();

  double grain_density;  ///< kg/m3
  double e_min, e_max;
  double critical_friction_angle;  ///< degrees
  double shear_modulus_number;     ///< g
  double poissons_ratio;
  double Q = 10, R = 1;
  /// m, degrees per unit of I_R; without it, that of the scene's kind.
  double strength_per_index = std::numeric_limits<double>::infinity();
  double stiffness_floor = 10e3;  ///< pressure below which the moduli fall no further [Pa]
  /// Whether grains part where there is no pressure, and bear nothing until they meet again, see Gaps.
  bool separation = true;
  double initial_void_ratio = 0;  ///< see `fill`

  bool may_separate() const { return separation; }
  bool keeps_gaps() const { return separation; }
  TangentModuli initial_moduli() const;
  double poisson_ratio() const { return poissons_ratio; }
  /// Throws BadParameter where the numbers do not go together.
  void check() const;
  /// Takes the void ratio from the bulk density [kg/m3]. Throws BadParameter where no sand of these grains has it.
  void fill(double density);
  /// Chooses the strength of the scene's kind where none was given.
  void choose_strength(bool in_plane_strain);

  /// Throws BadValue for a stress beyond the strength.
  State settled_state(const SettledStress& settled) const;
  /// Tangent modulus [Pa].
  double bulk_modulus(const SoilState& state, double pressure) const;

  /// The pressure beyond which not even the densest sand dilates, as its grains crush [Pa].
  double crushing_pressure() const;
  /// Whether a state is within the range of the model, which ends at that pressure.
  Tested tested(const SoilState& state, double pressure) const;

  double void_ratio(const SoilState& state) const;
  /// I_R at a pressure [Pa], compression positive, without a bound.
  double dilatancy_index(const SoilState& state, double pressure) const;
};

/// Returns once, to the strength and with the flow at the start of the step: exact on each part of the surface, and of
/// first order in the change of strength and flow within the step. An increment that is not finite is refused.
template <int D>
BatchFailure update(const BoltonSand& sand, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts);

}  // namespace tamp::components
