#pragma once

#include <array>
#include <string_view>

#include "components/materials/material_batch.hpp"
#include "components/materials/settled_start.hpp"
#include "components/parameter.hpp"

namespace tamp::components
{

/// A metal-like solid in the elastic range: stress grows with strain at constant moduli, Pa.
struct Hypoelastic {
  using State = NoState;
  static constexpr std::string_view type = "hypoelastic";
  static constexpr std::array<Parameter<Hypoelastic>, 2> parameters();

  double bulk_modulus;
  double shear_modulus;

  TangentModuli initial_moduli() const { return {bulk_modulus, shear_modulus}; }
  double poisson_ratio() const { return initial_moduli().poisson_ratio(); }
  /// It bears any stress.
  NoState settled_state(const SettledStress&) const { return {}; }
};

constexpr std::array<Parameter<Hypoelastic>, 2> Hypoelastic::parameters()
{
  return {{{"bulk_modulus", "Pa", above_zero, &Hypoelastic::bulk_modulus, "constant"},
           {"shear_modulus", "Pa", above_zero, &Hypoelastic::shear_modulus, "constant"}}};
}

/// stress += (K - 2G/3) tr(de) 1 + 2G de for each particle.
template <int D>
BatchFailure update(const Hypoelastic& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts& counts);

}  // namespace tamp::components
