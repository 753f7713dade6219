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

/// Soil with constant elastic moduli and the strength of Mohr and Coulomb, perfectly plastic. With principal stresses
/// s1 >= s2 >= s3, tension positive,
///
///     (s1 - s3) + (s1 + s3) sin(phi) <= 2 c cos(phi),
///
/// and flow follows the gradient of (s1 - s3) + (s1 + s3) sin(psi). Without friction it is Tresca's. Unlike the cone of
/// drucker_prager it has the strength of its angle in plane strain too.
struct MohrCoulomb {
  using State = SoilState;
  static constexpr std::string_view type = "mohr_coulomb";
  static constexpr bool is_soil = true;
  static constexpr char state_name[] = "mohr coulomb state";
  static std::span<const Parameter<MohrCoulomb>, 8> parameters();
  static std::span<const StateColumn<MohrCoulomb>, 2> columns();
  static std::span<const StateExtreme, 3> extremes();
  static constexpr std::string_view meaning_of_friction = "in triaxial compression and plane strain alike; below 90";
  static constexpr std::string_view meaning_of_cohesion = "above 0 where there is no friction";

  double bulk_modulus;        ///< Pa
  double shear_modulus;       ///< Pa
  double friction_angle;      ///< degrees
  double dilation_angle = 0;  ///< degrees, at most the friction angle
  double cohesion = 0;        ///< Pa
  /// The mean tension that it bears [Pa]; at most that of the apex, c / tan(phi).
  double tension_cutoff = std::numeric_limits<double>::infinity();
  /// Plastic volumetric expansion beyond which it widens no more as it is sheared.
  double dilation_limit = std::numeric_limits<double>::infinity();
  /// Whether grains part at the cut-off, and bear nothing until they meet again, see Gaps.
  bool separation = false;

  bool may_separate() const { return separation; }
  bool keeps_gaps() const { return separation; }
  TangentModuli initial_moduli() const { return {bulk_modulus, shear_modulus}; }
  /// The mean tension at the apex [Pa]; infinite without friction.
  double apex_tension() const;
  /// Throws BadParameter where the numbers do not go together.
  void check() const;

  double poisson_ratio() const { return initial_moduli().poisson_ratio(); }
  /// Throws BadValue for a stress beyond the strength.
  State settled_state(const SettledStress& settled) const;
};

/// Returns once to the surface, exact on each of its parts. An increment that is not finite is refused.
template <int D>
BatchFailure update(const MohrCoulomb& soil, const MaterialBatch<D, SoilState>& batch, UpdateCounts& counts);

}  // namespace tamp::components
