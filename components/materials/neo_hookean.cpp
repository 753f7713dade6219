#include "components/materials/neo_hookean.hpp"

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
template <int D, class Number>
ModuliOf<Number> moduli_of(const NeoHookean& solid, const Number& J, const Number& shear_share,
                           const SymmetricTensor<D, Number>& b)
{
  const auto [least, greatest] = principal_extremes(b);
  const Number stretch = greater_of<Number>(greatest, 5.0 / 9.0 * trace(b) - least / 3) + (greatest - least) / 3;
  return {0.5 * solid.bulk_modulus * (J + 1 / J), 0.75 * solid.shear_modulus * shear_share * stretch};
}

template <class Number>
Number shear_share_of(const Number& J)
{
  return portable::pow(J, Number(-5.0 / 3.0));
}

}  // namespace

template <int D>
BatchFailure update(const NeoHookean& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts&)
{
  for (std::size_t i = 0; i < batch.stress.size(); i += n_lanes) {
    const Matrix<D, Lanes> f = lanes_at(batch.deformation_gradient, i);
    const SymmetricTensor<D, Lanes> b = left_cauchy_green<D>(f);
    const Lanes J = f.determinant(), shear_share = shear_share_of(J);
    set_lanes<n_symmetric<D>, 1>(batch.stress, i,
                                 isotropic<n_symmetric<D>, Lanes>(0.5 * solid.bulk_modulus * (J - 1 / J)) +
                                     Lanes(solid.shear_modulus * shear_share) * deviator(b));
    const auto [bulk_modulus, shear_modulus] = moduli_of<D>(solid, J, shear_share, b);
    set_lanes(batch.bulk_modulus, i, bulk_modulus);
    set_lanes(batch.shear_modulus, i, shear_modulus);
  }
  std::ranges::fill(batch.plastic_work, 0.0);
  return std::nullopt;
}

template <int D>
double NeoHookean::stored_energy(const Matrix<D>& deformation_gradient) const
{
  const double J = deformation_gradient.determinant();
  const double square = trace(left_cauchy_green<D, double>(deformation_gradient));
  return 0.5 * bulk_modulus * (0.5 * (J * J - 1) - portable::log(J)) +
         0.5 * shear_modulus * (portable::pow(J, -2.0 / 3.0) * square - 3);
}

template <int D>
TangentModuli tangent_moduli(const NeoHookean& solid, const Matrix<D>& deformation_gradient)
{
  const double J = deformation_gradient.determinant();
  return moduli_of<D>(solid, J, shear_share_of(J), left_cauchy_green<D>(deformation_gradient));
}

template double NeoHookean::stored_energy<2>(const Matrix<2>&) const;
template double NeoHookean::stored_energy<3>(const Matrix<3>&) const;
template BatchFailure update<2>(const NeoHookean&, const MaterialBatch<2, NoState>&, UpdateCounts&);
template BatchFailure update<3>(const NeoHookean&, const MaterialBatch<3, NoState>&, UpdateCounts&);
template TangentModuli tangent_moduli<2>(const NeoHookean&, const Matrix<2>&);
template TangentModuli tangent_moduli<3>(const NeoHookean&, const Matrix<3>&);

}  // namespace tamp::components
