#pragma once

#include <cstddef>
#include <span>

#include "components/tensors.hpp"

namespace tamp::components
{

/// A metal-like solid in the elastic range: stress grows with strain at constant moduli, Pa.
struct Hypoelastic {
  double bulk_modulus;
  double shear_modulus;
};

/// Throws BadValue unless both moduli are positive and finite.
void check(const Hypoelastic& solid);

/// stress += (K - 2G/3) tr(de) 1 + 2G de for each particle: spans of equal length, tension positive, `stress` already
/// rotated to the end-of-step frame.
template <int D>
void update(const Hypoelastic& solid, std::span<const SymmetricTensor<D>> strain_increment,
            std::span<SymmetricTensor<D>> stress)
{
  for (std::size_t i = 0; i < strain_increment.size(); ++i) {
    const SymmetricTensor<D>& strain = strain_increment[i];
    stress[i] +=
        2 * solid.shear_modulus * deviator(strain) + isotropic<n_symmetric<D>>(solid.bulk_modulus * trace(strain));
  }
}

}  // namespace tamp::components
