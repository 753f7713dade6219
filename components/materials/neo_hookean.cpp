#include "components/materials/neo_hookean.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "components/portable_math.hpp"
#include "components/tensor_lanes.hpp"

namespace tamp::components
{

namespace
{

/// b = F F^T with b_33 = 1 in plane strain.
template <int D, class Number>
SymmetricTensor<D, Number> left_cauchy_green(const Matrix<D, Number>& f)
{
  return symmetric_part<D>(f * f.transpose(), 1.0);
}

template <class Number>
struct Extremes {
  Number least, greatest;
};

/// The least and the greatest principal value.
template <class Number>
Extremes<Number> principal_extremes(const Eigen::Matrix<Number, 4, 1>& b)
{
  const Number middle = 0.5 * (b[0] + b[1]), half = 0.5 * (b[0] - b[1]);
  const Number radius = sqrt(half * half + b[3] * b[3]);
  return {lesser_of<Number>(middle - radius, b[2]), greater_of<Number>(middle + radius, b[2])};
}

/// By the angle of the deviator, as the cubic has three real roots (O. K. Smith, Comm. ACM 4, 1961). Where two values
/// are almost equal they are good to 1e-8 of their distance from the third.
template <class Number>
Extremes<Number> principal_extremes(const Eigen::Matrix<Number, 6, 1>& b)
{
  const Eigen::Matrix<Number, 6, 1> s = deviator(b);
  const Number middle = trace(b) / 3, radius = sqrt(double_dot(s, s) / 6);
  const Number cosine = 0.5 * plane_part<3, Number>(s).determinant() / (radius * radius * radius);
  // In this order a cosine that is not a number counts as -1: without a radius any will do.
  const Number angle = portable::acos(lesser_of<Number>(greater_of<Number>(-1.0, cosine), 1.0)) / 3;
  return {middle + 2 * radius * portable::cos(angle + 2 * std::numbers::pi / 3),
          middle + 2 * radius * portable::cos(angle)};
}

/// See tangent_moduli.
template <class Number>
struct ModuliOf {
  Number bulk_modulus, shear_modulus;
};
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
  const auto [bulk_modulus, shear_modulus] =
      moduli_of<D>(solid, J, shear_share_of(J), left_cauchy_green<D>(deformation_gradient));
  return {bulk_modulus, shear_modulus};
}

template double NeoHookean::stored_energy<2>(const Matrix<2>&) const;
template double NeoHookean::stored_energy<3>(const Matrix<3>&) const;
template BatchFailure update<2>(const NeoHookean&, const MaterialBatch<2, NoState>&, UpdateCounts&);
template BatchFailure update<3>(const NeoHookean&, const MaterialBatch<3, NoState>&, UpdateCounts&);
template TangentModuli tangent_moduli<2>(const NeoHookean&, const Matrix<2>&);
template TangentModuli tangent_moduli<3>(const NeoHookean&, const Matrix<3>&);

}  // namespace tamp::components
