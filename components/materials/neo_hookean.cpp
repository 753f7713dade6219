#include "components/materials/neo_hookean.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

/// b = F F^T with b_33 = 1 in plane strain.
template <int D>
SymmetricTensor<D> left_cauchy_green(const Matrix<D>& f)
{
  return symmetric_part<D>(f * f.transpose(), 1);
}

struct Extremes {
  double least, greatest;
};

/// The least and the greatest principal value.
Extremes principal_extremes(const SymmetricTensor<2>& b)
{
  const double middle = 0.5 * (b[0] + b[1]), half = 0.5 * (b[0] - b[1]);
  const double radius = std::sqrt(half * half + b[3] * b[3]);
  return {std::min(middle - radius, b[2]), std::max(middle + radius, b[2])};
}

/// By the angle of the deviator, as the cubic has three real roots (O. K. Smith, Comm. ACM 4, 1961). Where two values
/// are almost equal they are good to 1e-8 of their distance from the third.
Extremes principal_extremes(const SymmetricTensor<3>& b)
{
  const SymmetricTensor<3> s = deviator(b);
  const double middle = trace(b) / 3, radius = std::sqrt(double_dot(s, s) / 6);
  if (!(radius > 0)) return {middle, middle};
  const double cosine = 0.5 * plane_part<3>(s).determinant() / (radius * radius * radius);
  const double angle = portable::acos(std::clamp(cosine, -1.0, 1.0)) / 3;
  return {middle + 2 * radius * portable::cos(angle + 2 * std::numbers::pi / 3),
          middle + 2 * radius * portable::cos(angle)};
}

}  // namespace

template <int D>
BatchFailure update(const NeoHookean& solid, const MaterialBatch<D, NoState>& batch, UpdateCounts&)
{
  for (std::size_t i = 0; i < batch.stress.size(); ++i) {
    const Matrix<D>& f = batch.deformation_gradient[i];
    const double J = f.determinant();
    batch.stress[i] = isotropic<n_symmetric<D>>(0.5 * solid.bulk_modulus * (J - 1 / J)) +
                      solid.shear_modulus * portable::pow(J, -5.0 / 3.0) * deviator(left_cauchy_green<D>(f));
    const TangentModuli moduli = tangent_moduli<D>(solid, f);
    batch.bulk_modulus[i] = moduli.bulk_modulus;
    batch.shear_modulus[i] = moduli.shear_modulus;
  }
  std::ranges::fill(batch.plastic_work, 0.0);
  return std::nullopt;
}

template <int D>
double NeoHookean::stored_energy(const Matrix<D>& deformation_gradient) const
{
  const double J = deformation_gradient.determinant();
  const double square = trace(left_cauchy_green<D>(deformation_gradient));
  return 0.5 * bulk_modulus * (0.5 * (J * J - 1) - portable::log(J)) +
         0.5 * shear_modulus * (portable::pow(J, -2.0 / 3.0) * square - 3);
}

template <int D>
TangentModuli tangent_moduli(const NeoHookean& solid, const Matrix<D>& deformation_gradient)
{
  const double J = deformation_gradient.determinant();
  const SymmetricTensor<D> b = left_cauchy_green<D>(deformation_gradient);
  const auto [least, greatest] = principal_extremes(b);
  const double stretch = std::max(greatest, 5.0 / 9.0 * trace(b) - least / 3) + (greatest - least) / 3;
  return {0.5 * solid.bulk_modulus * (J + 1 / J), 0.75 * solid.shear_modulus * portable::pow(J, -5.0 / 3.0) * stretch};
}

template double NeoHookean::stored_energy<2>(const Matrix<2>&) const;
template double NeoHookean::stored_energy<3>(const Matrix<3>&) const;
template BatchFailure update<2>(const NeoHookean&, const MaterialBatch<2, NoState>&, UpdateCounts&);
template BatchFailure update<3>(const NeoHookean&, const MaterialBatch<3, NoState>&, UpdateCounts&);
template TangentModuli tangent_moduli<2>(const NeoHookean&, const Matrix<2>&);
template TangentModuli tangent_moduli<3>(const NeoHookean&, const Matrix<3>&);

}  // namespace tamp::components
