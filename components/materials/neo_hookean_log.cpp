#include "components/materials/neo_hookean_log.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cstddef>

#include "components/materials/left_cauchy_green.hpp"
#include "components/portable_math.hpp"
#include "components/tensor_lanes.hpp"

namespace tamp::components
{

namespace
{

/// See tangent_moduli.
template <class Number>
ModuliOf<Number> moduli_of(const NeoHookeanLog& solid, const Number& J, const Number& log_J, const Number& b_max)
{
  const Number volumetric = 1 - lesser_of<Number>(log_J, log_J / 3);
  const Number shear = solid.shear_modulus * (b_max + 1) / J;
  return {shear / 3 + solid.lambda() * greater_of<Number>(volumetric, 0.0) / J, 0.5 * shear};
}

}  // namespace

void NeoHookeanLog::check() const
{
  constexpr double rounding = 1e-6;
  if (lambda() >= -rounding * shear_modulus) return;
  throw BadParameter("bulk_modulus", fmt::format("{}", bulk_modulus),
                     fmt::format("at least 2/3 of the shear modulus, {}", 2.0 / 3.0 * shear_modulus));
}

template <int D>
BatchFailure update(const NeoHookeanLog& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts&)
{
  for (std::size_t i = 0; i < batch.stress.size(); i += n_lanes) {
    const Matrix<D, Lanes> f = lanes_at(batch.deformation_gradient, i);
    const SymmetricTensor<D, Lanes> b = left_cauchy_green<D>(f);
    const Lanes J = f.determinant(), log_J = portable::log(J);
    set_lanes<n_symmetric<D>, 1>(batch.stress, i,
                                 isotropic<n_symmetric<D>, Lanes>((solid.lambda() * log_J - solid.shear_modulus) / J) +
                                     Lanes(solid.shear_modulus / J) * b);
    const auto [bulk_modulus, shear_modulus] = moduli_of<Lanes>(solid, J, log_J, principal_extremes(b).greatest);
    set_lanes(batch.bulk_modulus, i, bulk_modulus);
    set_lanes(batch.shear_modulus, i, shear_modulus);
  }
  std::ranges::fill(batch.plastic_work, 0.0);
  return std::nullopt;
}

template <int D>
double NeoHookeanLog::stored_energy(const Matrix<D>& deformation_gradient) const
{
  const double log_J = portable::log(deformation_gradient.determinant());
  const double square = trace(left_cauchy_green<D, double>(deformation_gradient));
  return 0.5 * shear_modulus * (square - 3) + (0.5 * lambda() * log_J - shear_modulus) * log_J;
}

template <int D>
TangentModuli tangent_moduli(const NeoHookeanLog& solid, const Matrix<D>& deformation_gradient)
{
  const double J = deformation_gradient.determinant();
  const double b_max = principal_extremes(left_cauchy_green<D>(deformation_gradient)).greatest;
  return moduli_of(solid, J, portable::log(J), b_max);
}

template double NeoHookeanLog::stored_energy<2>(const Matrix<2>&) const;
template double NeoHookeanLog::stored_energy<3>(const Matrix<3>&) const;
template BatchFailure update<2>(const NeoHookeanLog&, const MaterialBatch<2, NoState>&, UpdateCounts&);
template BatchFailure update<3>(const NeoHookeanLog&, const MaterialBatch<3, NoState>&, UpdateCounts&);
template TangentModuli tangent_moduli<2>(const NeoHookeanLog&, const Matrix<2>&);
template TangentModuli tangent_moduli<3>(const NeoHookeanLog&, const Matrix<3>&);

}  // namespace tamp::components
