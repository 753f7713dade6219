#include "components/materials/principal_stresses.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <catch2/catch.hpp>
#include <random>
#include <string>
#include <vector>

namespace test_principal_stresses
{

using namespace tamp;
using components::Principal;
using components::PrincipalValues;

namespace
{

/// Tensors of all kinds: with any values, two or three equal ones, and a pressure that is large beside the rest.
template <int D>
std::vector<SymmetricTensor<D>> some_tensors()
{
  std::mt19937_64 random(3);
  std::normal_distribution<double> any(0, 1);
  std::vector<SymmetricTensor<D>> all{SymmetricTensor<D>::Zero(), isotropic<n_symmetric<D>>(-2.0)};
  for (int i = 0; i < 3; ++i) all.push_back(SymmetricTensor<D>::Unit(i));
  for (int i = 0; i < 500; ++i) {
    SymmetricTensor<D> a;
    for (int k = 0; k < n_symmetric<D>; ++k) a[k] = any(random);
    all.push_back(a);
    all.push_back(a + isotropic<n_symmetric<D>>(-1e6));
    // A tensor with two equal principal values: isotropic, plus a multiple of the projection on a direction.
    Vector<D> n;
    for (int k = 0; k < D; ++k) n[k] = any(random);
    n.normalize();
    all.push_back(isotropic<n_symmetric<D>>(any(random)) + symmetric_part<D>(n * n.transpose(), 0.0));
  }
  return all;
}

template <int D>
Matrix<3> matrix_of(const SymmetricTensor<D>& a)
{
  Matrix<3> m = Matrix<3>::Zero();
  m.topLeftCorner<D, D>() = plane_part<D>(a);
  m(2, 2) = a[2];
  return m;
}

template <int D>
void check_all()
{
  for (const SymmetricTensor<D>& a : some_tensors<D>()) {
    const double scale = std::max(a.cwiseAbs().maxCoeff(), 1e-300);
    const Principal<D, double> axes(a);
    const PrincipalValues<double> values = axes.values();
    Vector<3> expected = Eigen::SelfAdjointEigenSolver<Matrix<3>>(matrix_of<D>(a)).eigenvalues().reverse();

    CAPTURE(D, a.transpose());
    for (std::size_t k = 0; k < 3; ++k) {
      REQUIRE(std::abs(values[k] - expected[static_cast<Eigen::Index>(k)]) <= 4e-15 * scale);
    }
    REQUIRE((axes.with(values) - a).cwiseAbs().maxCoeff() <= 4e-15 * scale);
    // Squares of a tensor have the same axes.
    const Matrix<3> m = matrix_of<D>(a), square = m * m;
    const PrincipalValues<double> squares{values[0] * values[0], values[1] * values[1], values[2] * values[2]};
    REQUIRE((matrix_of<D>(axes.with(squares)) - square).cwiseAbs().maxCoeff() <= 2e-14 * scale * scale);
  }
}

}  // namespace

TEST_CASE("a symmetric tensor has the principal values that Eigen finds, and is made of them again")
{
  check_all<2>();
  check_all<3>();
}

}  // namespace test_principal_stresses
