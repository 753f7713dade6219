#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>

#include "components/materials/material_batch.hpp"
#include "components/materials/state_columns.hpp"
#include "components/parameter.hpp"

namespace tamp::components
{

struct DruckerPragerState {
  double plastic_volumetric = 0;  ///< compression positive: dilation makes it fall
  double equivalent_plastic = 0;  ///< sum of sqrt(2/3 de:de), e the plastic strain's deviator
};

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
  using State = DruckerPragerState;
  static constexpr std::string_view type = "drucker_prager";
  static constexpr bool is_soil = true;
  static constexpr char state_name[] = "drucker prager state";
  static std::span<const Parameter<DruckerPrager>, 6> parameters();
  static std::span<const StateColumn<DruckerPrager>, 2> columns();
  static std::span<const StateExtreme, 3> extremes();

  double bulk_modulus;        ///< Pa
  double shear_modulus;       ///< Pa
  double friction_angle;      ///< degrees
  double dilation_angle = 0;  ///< degrees, at most the friction angle
  double cohesion = 0;        ///< Pa
  /// The mean tension that it bears [Pa]; at most that of the cone's apex, c / tan(phi).
  double tension_cutoff = std::numeric_limits<double>::infinity();

  TangentModuli initial_moduli() const { return {bulk_modulus, shear_modulus}; }
  /// The mean tension at which the cone ends [Pa]; infinite without friction.
  double apex_tension() const;
  /// Throws BadParameter where the numbers do not go together.
  void check() const;
};

/// One return to the cone, the cut-off, or where they meet: exact, however long the increment, where a straight path
/// starts without shear and does not meet the cut-off before the cone; of first order otherwise. An increment that is
/// not finite is refused.
template <int D>
BatchFailure update(const DruckerPrager& soil, const MaterialBatch<D, DruckerPragerState>& batch, UpdateCounts& counts);

}  // namespace tamp::components
