#pragma once

#include <array>
#include <string_view>

#include "components/materials/material_batch.hpp"
#include "components/parameter.hpp"

namespace tamp::components
{

/// A compressible neo-Hookean solid of logarithmic form, the one that manufactured solutions are usually made for:
/// elastic, its moduli those of small strains, Pa. With J = det F, b = F F^T, b_33 = 1 in plane strain, and Lamé's
/// lambda = K - 2/3 G, its energy per reference volume is
///
///     W = G/2 (tr b - 3) - G ln J + lambda/2 (ln J)^2
///
/// (J. Bonet and R. D. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, Cambridge 1997). Unlike in
/// neo_hookean.hpp, changes of shape make pressure too, and without a Poisson's ratio stretches of different axes do
/// not feel each other.
struct NeoHookeanLog {
  using State = NoState;
  static constexpr std::string_view type = "neo_hookean_log";
  static constexpr std::array<Parameter<NeoHookeanLog>, 2> parameters();

  double bulk_modulus;
  double shear_modulus;

  /// Throws BadParameter where lambda is below 0 by more than the rounding of 2/3 G: under pressure such a solid would
  /// give way without bound.
  void check() const;

  double lambda() const { return bulk_modulus - 2.0 / 3.0 * shear_modulus; }
  TangentModuli initial_moduli() const { return {bulk_modulus, shear_modulus}; }
  /// W [J per m^3 of the undeformed material].
  template <int D>
  double stored_energy(const Matrix<D>& deformation_gradient) const;
};

constexpr std::array<Parameter<NeoHookeanLog>, 2> NeoHookeanLog::parameters()
{
  return {{{"bulk_modulus", "Pa", above_zero, &NeoHookeanLog::bulk_modulus,
            "at small strain; at least 2/3 of the shear modulus, which is a Poisson's ratio of 0"},
           {"shear_modulus", "Pa", above_zero, &NeoHookeanLog::shear_modulus, "at small strain"}}};
}

/// Cauchy stress sigma = (lambda ln J 1 + G (b - 1)) / J of each particle, from its deformation gradient, whose
/// determinant is above 0; and its tangent moduli.
template <int D>
BatchFailure update(const NeoHookeanLog& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts& counts);

/// Moduli whose wave speed sqrt((K_t + 4/3 G_t) / rho) no wave exceeds, whatever its direction and polarisation. A wave
/// with normal n and polarisation a, unit vectors with m = a . n, deforms to (1 + s a (x) n) F, so that J goes to
/// J (1 + s m) and tr b to tr b + 2 s a.bn + s^2 n.bn; rho c^2 is the second derivative of W / J by s:
///
///     J rho c^2 = G n.bn + (G + lambda (1 - ln J)) m^2.
///
/// With b_max the greatest eigenvalue of b, this is at most G (b_max + 1) + lambda max(0, 1 - ln J), which for J <= e
/// the wave with a and n along that axis has. An equal strain of all axes, (1 + s) F, which moves a particle that has
/// its nodes to itself, has the modulus of the second derivative by s over 9 J, or in the plane over 4 J:
///
///     in space J M = G (tr b + 3) / 9 + lambda (1 - ln J / 3), in the plane G (b_11 + b_22 + 2) / 4 + lambda (1 - ln J
///     / 2).
///
/// K_t + (2/D - 2/3) G_t is to be no less. Both hold for
///
///     J K_t = G (b_max + 1) / 3 + lambda max(0, 1 - ln J, 1 - ln J / 3),    J G_t = G (b_max + 1) / 2:
///
/// K and G without strain. The first bound is exact for J <= 1, the second for equal stretches beyond that.
template <int D>
TangentModuli tangent_moduli(const NeoHookeanLog& solid, const Matrix<D>& deformation_gradient);

}  // namespace tamp::components
