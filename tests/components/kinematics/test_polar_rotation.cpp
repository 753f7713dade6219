#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <random>

#include "components/kinematics/polar_rotation.hpp"

namespace test_polar_rotation
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// Reference: from the singular values F = A S B^T, R = A B^T.
template <int D>
Matrix<D> rotation_by_svd(const Matrix<D>& f)
{
  const Eigen::JacobiSVD<Matrix<D>> svd(f, Eigen::ComputeFullU | Eigen::ComputeFullV);
  return svd.matrixU() * svd.matrixV().transpose();
}

/// Random rotation times random singular values from 1 / spread to spread, times another rotation.
template <int D>
Matrix<D> random_deformation(std::mt19937& random, double spread)
{
  std::uniform_real_distribution<double> uniform(-1, 1);
  const auto any_rotation = [&] {
    const Matrix<D> m = Matrix<D>::NullaryExpr([&] { return uniform(random); });
    Matrix<D> q = rotation_by_svd<D>(m);
    if (q.determinant() < 0) q.col(0) *= -1;
    return q;
  };
  const Matrix<D> a = any_rotation(), b = any_rotation();
  const Vector<D> stretches = Vector<D>::NullaryExpr([&] { return std::pow(spread, uniform(random)); });
  return a * stretches.asDiagonal() * b;
}

/// The largest difference from the reference, over how far round-off in F alone may turn R: |F| over the sum of the two
/// smallest singular values.
template <int D>
double largest_error(double spread)
{
  std::mt19937 random(7);
  double largest = 0;
  for (int sample = 0; sample < 1000; ++sample) {
    const Matrix<D> f = random_deformation<D>(random, spread);
    const Vector<D> stretches = Eigen::JacobiSVD<Matrix<D>>(f).singularValues();
    const double sensitivity = stretches[0] / (stretches[D - 2] + stretches[D - 1]);
    largest = std::max(largest, (polar_rotation(f) - rotation_by_svd<D>(f)).cwiseAbs().maxCoeff() / sensitivity);
  }
  return largest;
}

}  // namespace

TEST_CASE("the polar rotation is that of the singular value decomposition")
{
  for (const double spread : {1.0, 1.01, 3.0, 1e3}) {
    CHECK(largest_error<2>(spread) < 1e-14);
    CHECK(largest_error<3>(spread) < 1e-14);
  }
}

TEST_CASE("the polar rotation is orthogonal and the stretch it leaves is symmetric")
{
  std::mt19937 random(11);
  for (const double spread : {1.0, 1.1, 5.0}) {
    for (int sample = 0; sample < 1000; ++sample) {
      const Matrix<3> f = random_deformation<3>(random, spread);
      const Matrix<3> r = polar_rotation(f);
      const Matrix<3> stretch = r.transpose() * f;

      REQUIRE((r.transpose() * r - Matrix<3>::Identity()).norm() < 3e-15);
      REQUIRE((stretch - stretch.transpose()).norm() < 1e-14 * f.norm());
    }
  }
}

TEST_CASE("the polar rotation of a particle that is almost flat is still to round-off")
{
  const Matrix<3> turn = Eigen::AngleAxisd(2.5, Vector<3>(1, -2, 2) / 3).toRotationMatrix();
  const Matrix<3> flat = turn * Vector<3>(2, 1, 1e-12).asDiagonal();

  CHECK((polar_rotation(flat) - turn).norm() < 1e-14);
}

TEST_CASE("without a branch the polar rotation is the iterated one up to stretches a thousand times apart")
{
  std::mt19937 random(13);
  for (const double spread : {1.0, 1.1, 5.0, 30.0}) {
    for (int sample = 0; sample < 1000; ++sample) {
      const Matrix<3> f = random_deformation<3>(random, spread);
      const Matrix<3> g = random_deformation<3>(random, spread);
      const auto lanes = [](const Matrix<3>& m) {
        return Matrix<3, Lanes>(m.unaryExpr([](double x) { return Lanes(x); }));
      };
      const auto of_both = polar_rotations(lanes(f), lanes(g));
      const auto lane = [](const Lanes& x) -> double { return x[n_lanes - 1]; };
      const Matrix<3> r = of_both[0].unaryExpr(lane), other = of_both[1].unaryExpr(lane);

      REQUIRE((r.transpose() * r - Matrix<3>::Identity()).norm() < 3e-15);
      REQUIRE((r - polar_rotation(f)).norm() < 1e-14 * spread * spread);
      REQUIRE((other - polar_rotation(g)).norm() < 1e-14 * spread * spread);
    }
  }
}

TEST_CASE("the polar rotation of a pure stretch is the identity and of a rotation itself")
{
  const Matrix<2> stretch = (Matrix<2>() << 2, 0.3, 0.3, 0.5).finished();
  const Matrix<2> half_turn = -Matrix<2>::Identity();
  const Matrix<3> quarter_turn = (Matrix<3>() << 0, 0, 1, 1, 0, 0, 0, 1, 0).finished();

  CHECK((polar_rotation(stretch) - Matrix<2>::Identity()).norm() == 0);
  CHECK((polar_rotation(half_turn) - half_turn).norm() == 0);
  CHECK((polar_rotation(quarter_turn) - quarter_turn).norm() < 1e-15);
}

}  // namespace test_polar_rotation
