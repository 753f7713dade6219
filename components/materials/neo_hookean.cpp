#include "components/materials/neo_hookean.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>
#include <cstddef>

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

template <int D>
Extremes principal_extremes(const SymmetricTensor<D>& b)
{
  Eigen::SelfAdjointEigenSolver<Matrix<D>> solver;
  solver.computeDirect(plane_part<D>(b), Eigen::EigenvaluesOnly);
  const auto& in_plane = solver.eigenvalues();
  if constexpr (D == 3) return {in_plane[0], in_plane[2]};
  return {std::min(in_plane[0], b[2]), std::max(in_plane[D - 1], b[2])};
}

}  // namespace

template <int D>
void update(const NeoHookean& solid, std::span<const Matrix<D>> deformation_gradient,
            std::span<SymmetricTensor<D>> stress)
{
  for (std::size_t i = 0; i < stress.size(); ++i) {
    const Matrix<D>& f = deformation_gradient[i];
    const double J = f.determinant();
    stress[i] = isotropic<n_symmetric<D>>(0.5 * solid.bulk_modulus * (J - 1 / J)) +
                solid.shear_modulus * std::pow(J, -5.0 / 3.0) * deviator(left_cauchy_green<D>(f));
  }
}

template <int D>
TangentModuli tangent_moduli(const NeoHookean& solid, const Matrix<D>& deformation_gradient)
{
  const double J = deformation_gradient.determinant();
  const SymmetricTensor<D> b = left_cauchy_green<D>(deformation_gradient);
  const auto [least, greatest] = principal_extremes<D>(b);
  const double stretch = std::max(greatest, 5.0 / 9.0 * trace(b) - least / 3) + (greatest - least) / 3;
  return {0.5 * solid.bulk_modulus * (J + 1 / J), 0.75 * solid.shear_modulus * std::pow(J, -5.0 / 3.0) * stretch};
}

template void update<2>(const NeoHookean&, std::span<const Matrix<2>>, std::span<SymmetricTensor<2>>);
template void update<3>(const NeoHookean&, std::span<const Matrix<3>>, std::span<SymmetricTensor<3>>);
template TangentModuli tangent_moduli<2>(const NeoHookean&, const Matrix<2>&);
template TangentModuli tangent_moduli<3>(const NeoHookean&, const Matrix<3>&);

}  // namespace tamp::components
