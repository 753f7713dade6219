#pragma once

#include <array>
#include <string_view>

#include "components/materials/material_batch.hpp"
#include "components/parameter.hpp"

namespace tamp::components
{

/// A compressible neo-Hookean solid: elastic at any strain, its moduli those of small strains, Pa. With J = det F and
/// b = F F^T, b_33 = 1 in plane strain, its energy per reference volume is
///
///     W = K/2 ((J^2 - 1)/2 - ln J) + G/2 (J^(-2/3) tr b - 3),
///
/// which is without bound both for J -> 0 and J -> infinity (J. C. Simo and T. J. R. Hughes, Computational
/// Inelasticity, Springer 1998, section 9.2).
struct NeoHookean {
  using State = NoState;
  static constexpr std::string_view type = "neo_hookean";
  static constexpr std::array<Parameter<NeoHookean>, 2> parameters();

  double bulk_modulus;
  double shear_modulus;

  TangentModuli initial_moduli() const { return {bulk_modulus, shear_modulus}; }
  /// W [J per m^3 of the undeformed material].
  template <int D>
  double stored_energy(const Matrix<D>& deformation_gradient) const;
};

constexpr std::array<Parameter<NeoHookean>, 2> NeoHookean::parameters()
{
  return {{{"bulk_modulus", "Pa", above_zero, &NeoHookean::bulk_modulus, "at small strain"},
           {"shear_modulus", "Pa", above_zero, &NeoHookean::shear_modulus, "at small strain"}}};
}

/// Cauchy stress sigma = K/2 (J - 1/J) 1 + G J^(-5/3) dev b of each particle, from its deformation gradient, whose
/// determinant is above 0; and its tangent moduli.
template <int D>
BatchFailure update(const NeoHookean& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts& counts);

/// Moduli whose wave speed sqrt((K_t + 4/3 G_t) / rho) no wave exceeds, whatever its direction and polarisation. A wave
/// with normal n and polarisation a, unit vectors with m = a . n, deforms to (1 + s a (x) n) F, and rho c^2 is the
/// second derivative of W / J by s:
///
///     rho c^2 = K/2 (J + 1/J) m^2 + G J^(-5/3) (n.bn + 5/9 tr b m^2 - 4/3 m a.bn).
///
/// With a = m n + sqrt(1 - m^2) t, the bracket is n.bn (1 - 4/3 m^2) + 5/9 tr b m^2 - 4/3 m sqrt(1 - m^2) t.bn. Its
/// first two terms are linear in m^2, and so at most max(b_max, 5/9 tr b - b_min/3), b_min and b_max being the extreme
/// eigenvalues of b; in the last, |t.bn| <= (b_max - b_min)/2 and |m| sqrt(1 - m^2) <= 1/2. Hence K_t = K/2 (J + 1/J)
/// and
///
///     4/3 G_t = G J^(-5/3) (max(b_max, 5/9 tr b - b_min/3) + (b_max - b_min)/3):
///
/// K and G without strain, and exact for pure changes of volume.
template <int D>
TangentModuli tangent_moduli(const NeoHookean& solid, const Matrix<D>& deformation_gradient);

}  // namespace tamp::components
