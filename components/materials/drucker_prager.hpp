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

/// Sand or soil for which triaxial tests are all there is: constant elastic moduli, and perfectly plastic on the cone
///
///     sqrt(J2) = k + alpha p,
///     alpha = 2 sqrt(3) sin(phi) / (3 - sin(phi)),
///     k = 2 sqrt(3) c cos(phi) / (3 - sin(phi)),
///
/// p compression positive, which in triaxial compression has the strength of Mohr and Coulomb's friction angle phi and
/// cohesion c. Plastic flow follows the gradient of sqrt(J2) - beta p, where beta is computed from the dilation angle
/// as alpha is from phi; at the tension cut-off, that of -p. (D. C. Drucker and W. Prager, Q. Appl. Math. 10, 1952; E.
/// A. de Souza Neto, D. Peric and D. R. J. Owen, Computational Methods for Plasticity, Wiley 2008, section 8.3.)
struct DruckerPrager {
  using State = SoilState;
  static constexpr std::string_view type = "drucker_prager";
  static constexpr bool is_soil = true;
  static constexpr char state_name[] = "drucker prager state";
  static std::span<const Parameter<DruckerPrager>, 8> parameters();
  static std::span<const StateColumn<DruckerPrager>, 2> columns();
  static std::span<const StateExtreme, 3> extremes();
  static constexpr std::string_view meaning_of_friction =
      "Mohr and Coulomb's, in triaxial compression; from 0 to below 90";
  static constexpr std::string_view meaning_of_cohesion =
      "Mohr and Coulomb's, in triaxial compression; above 0 where there is no friction";

  double bulk_modulus;        ///< Pa
  double shear_modulus;       ///< Pa
  double friction_angle;      ///< degrees
  double dilation_angle = 0;  ///< degrees, at most the friction angle
  double cohesion = 0;        ///< Pa
  /// The mean tension that it bears [Pa]; at most that of the cone's apex, c / tan(phi).
  double tension_cutoff = std::numeric_limits<double>::infinity();
  /// Plastic volumetric expansion beyond which it widens no more as it is sheared.
  double dilation_limit = std::numeric_limits<double>::infinity();
  /// Whether grains part at the cut-off, and bear nothing until they meet again, see Gaps.
  bool separation = false;

  bool may_separate() const { return separation; }
  bool keeps_gaps() const { return separation; }
  TangentModuli initial_moduli() const { return {bulk_modulus, shear_modulus}; }
  /// The mean tension at which the cone ends [Pa]; infinite without friction.
  double apex_tension() const;
  /// Throws BadParameter where the numbers do not go together.
  void check() const;

  double poisson_ratio() const { return initial_moduli().poisson_ratio(); }
  /// Throws BadValue for a stress outside of the cone, or in more tension than the cut-off.
  State settled_state(const SettledStress& settled) const;
};

/// Returns once, to the cone, the cut-off, or where they meet: exact, however long the increment, where a straight path
/// starts without shear and does not meet the cut-off before the cone; of first order otherwise. An increment that is
/// not finite is refused.
template <int D>
BatchFailure update(const DruckerPrager& soil, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts);

}  // namespace tamp::components
