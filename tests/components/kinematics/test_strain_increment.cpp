#include <catch2/catch.hpp>

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

#include "components/kinematics/deformation_update.hpp"
#include "components/kinematics/strain_increment.hpp"

namespace test_strain_increment
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// A smooth path of shear, stretch and rotation with a known velocity gradient: F = Q(t) A(t) with Q a rotation at a
/// varying rate about a fixed axis and A upper triangular.
template <int D>
struct Path {
  static double angle(double t) { return 1.3 * t + 0.4 * t * t; }

  static Matrix<D> turn(double t)
  {
    if constexpr (D == 2) {
      return Eigen::Rotation2Dd(angle(t)).toRotationMatrix();
    } else {
      return Eigen::AngleAxisd(angle(t), Vector<3>(1, 2, 2) / 3).toRotationMatrix();
    }
  }

  static Matrix<D> shape(double t)
  {
    Matrix<D> a = Matrix<D>::Identity();
    a(0, 0) = std::exp(0.3 * t);
    a(0, 1) = 0.8 * t * t;
    a(1, 1) = 1 - 0.2 * t;
    if constexpr (D == 3) a(1, 2) = 0.5 * t;
    return a;
  }

  static Matrix<D> shape_rate(double t)
  {
    Matrix<D> a = Matrix<D>::Zero();
    a(0, 0) = 0.3 * std::exp(0.3 * t);
    a(0, 1) = 1.6 * t;
    a(1, 1) = -0.2;
    if constexpr (D == 3) a(1, 2) = 0.5;
    return a;
  }

  static Matrix<D> deformation(double t) { return turn(t) * shape(t); }

  /// sym L with L = F' F^-1; the rate of Q is antisymmetric and leaves only the rate of A.
  static Matrix<D> rate_of_deformation(double t)
  {
    const Matrix<D> l = turn(t) * (shape_rate(t) * shape(t).inverse()) * turn(t).transpose();
    return 0.5 * (l + l.transpose());
  }

  static Matrix<D> rotation(double t)
  {
    const Eigen::JacobiSVD<Matrix<D>> svd(deformation(t), Eigen::ComputeFullU | Eigen::ComputeFullV);
    return svd.matrixU() * svd.matrixV().transpose();
  }
};

/// Reference: integral of R^T D R over 0..1 by Simpson's rule, R by singular values, turned to the end.
template <int D>
Matrix<D> integrated_strain()
{
  constexpr int n = 2000;
  Matrix<D> sum = Matrix<D>::Zero();
  for (int i = 0; i <= n; ++i) {
    const double t = static_cast<double>(i) / n;
    const double weight = (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3.0 * n);
    sum += weight * Path<D>::rotation(t).transpose() * Path<D>::rate_of_deformation(t) * Path<D>::rotation(t);
  }
  return Path<D>::rotation(1) * sum * Path<D>::rotation(1).transpose();
}

/// The strain at t = 1 of the path, taken in `n` steps.
template <int D>
Matrix<D> stepped_strain(int n)
{
  Matrix<D> f = Path<D>::deformation(0);
  SymmetricTensor<D> strain = SymmetricTensor<D>::Zero();
  for (int i = 0; i < n; ++i) {
    const Matrix<D> next = Path<D>::deformation((i + 1.0) / n);
    const Matrix<D> g = next * f.inverse() - Matrix<D>::Identity();
    const auto step = strain_increment<D>(f, g);
    strain = rotated<D>(strain, step.rotation_increment) + step.strain_increment;
    f = step.deformation_gradient;
  }
  return plane_part<D>(strain);
}

template <int D>
double observed_order()
{
  const Matrix<D> exact = integrated_strain<D>();
  return std::log2((stepped_strain<D>(40) - exact).norm() / (stepped_strain<D>(80) - exact).norm());
}

}  // namespace

TEST_CASE("a rigid rotation of a deformed particle is no strain, however far one step turns it")
{
  const Matrix<2> stretched = (Matrix<2>() << 1.2, 0.1, -0.2, 0.7).finished();
  const Matrix<3> stretched_in_space = (Matrix<3>() << 1.2, 0.1, 0.3, -0.2, 0.7, 0, 0, 0.1, 1.1).finished();
  const Vector<3> axis = Vector<3>(1, -2, 3).normalized();

  for (const double angle : {1e-6, 0.01, 0.5, 1.5, 3.0}) {
    const Matrix<2> turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
    const Matrix<3> turn_in_space = Eigen::AngleAxisd(angle, axis).toRotationMatrix();

    const auto plane = strain_increment<2>(stretched, turn - Matrix<2>::Identity());
    const auto space = strain_increment<3>(stretched_in_space, turn_in_space - Matrix<3>::Identity());

    // Near half a turn (I + g/2) is nearly singular and magnifies round-off by 1 / cos(angle / 2).
    const double round_off = 4e-15 / std::cos(angle / 2);
    CHECK(plane.strain_increment.norm() < round_off);
    CHECK(space.strain_increment.norm() < round_off);
    CHECK((plane.rotation_increment - turn).norm() < 1e-14);
    CHECK((space.rotation_increment - turn_in_space).norm() < 1e-14);
  }
}

TEST_CASE("a thousand small rotations gather no strain and keep a carried stress")
{
  constexpr int n_steps = 1000;
  const Matrix<3> turn = Eigen::AngleAxisd(2 * std::numbers::pi / n_steps, Vector<3>(1, 2, -2) / 3).toRotationMatrix();
  const SymmetricTensor<3> at_start = (SymmetricTensor<3>() << 1, -2, 0.5, 0.3, 0.7, -0.1).finished();
  Matrix<3> f = (Matrix<3>() << 1.2, 0.1, 0.3, -0.2, 0.7, 0, 0, 0.1, 1.1).finished();
  SymmetricTensor<3> strain = SymmetricTensor<3>::Zero(), stress = at_start;

  for (int i = 0; i < n_steps; ++i) {
    const auto step = strain_increment<3>(f, turn - Matrix<3>::Identity());
    strain = rotated<3>(strain, step.rotation_increment) + step.strain_increment;
    stress = rotated<3>(stress, step.rotation_increment);
    f = step.deformation_gradient;
  }

  CHECK(strain.norm() < 1e-12);
  CHECK((stress - at_start).norm() < 1e-11);
}

TEST_CASE("a uniaxial stretch sums to its logarithm, with an error of second order")
{
  const auto error = [](int n) {
    const double per_step = 1.0 / n;  // equal lengths: from 1 to 2
    Matrix<2> f = Matrix<2>::Identity();
    double strain = 0;
    for (int i = 0; i < n; ++i) {
      Matrix<2> g = Matrix<2>::Zero();
      g(0, 0) = per_step / f(0, 0);
      const auto step = strain_increment<2>(f, g);
      strain += step.strain_increment[0];
      f = step.deformation_gradient;
    }
    CHECK(f(0, 0) == Approx(2));
    return std::abs(strain - std::log(2.0));
  };

  CHECK(error(100) < 1e-5);
  CHECK(std::log2(error(50) / error(100)) == Approx(2).margin(0.02));
}

TEST_CASE("in plane strain nothing strains out of the plane")
{
  const Matrix<2> f = (Matrix<2>() << 1.2, 0.1, -0.2, 0.7).finished(), g = 0.1 * f;

  const auto step = strain_increment<2>(f, g);

  CHECK(step.strain_increment[2] == 0);
}

TEST_CASE("strain along a path of shear, stretch and rotation converges with second order")
{
  CHECK((stepped_strain<2>(640) - integrated_strain<2>()).norm() < 1e-5);
  CHECK((stepped_strain<3>(640) - integrated_strain<3>()).norm() < 1e-5);
  CHECK(observed_order<2>() == Approx(2).margin(0.05));
  CHECK(observed_order<3>() == Approx(2).margin(0.05));
}

TEST_CASE("the volume ratio is that of the deformation gradients and its logarithm that of the strain")
{
  const Matrix<3> f = (Matrix<3>() << 1.2, 0.1, 0.3, -0.2, 0.7, 0, 0, 0.1, 1.1).finished();
  const Matrix<3> g = 1e-3 * (Matrix<3>() << -2, 1, 0.5, 3, -1, 2, 0.3, -2, 1.5).finished();

  const auto step = strain_increment<3>(f, g);

  CHECK(step.deformation_gradient.determinant() == Approx(step.volume_ratio * f.determinant()).epsilon(1e-14));
  // The next term of the logarithm is cubic in g.
  CHECK(trace(step.strain_increment) == Approx(std::log(step.volume_ratio)).margin(1e-8));
}

TEST_CASE("a step that turns a particle inside out or over is reported and does nothing else")
{
  const Matrix<2> f = Matrix<2>::Identity();
  const Matrix<2> inside_out = (Matrix<2>() << -1.5, 0, 0, 0).finished();
  const Matrix<2> half_turn = -2 * Matrix<2>::Identity();
  const Matrix<2> not_a_number = Matrix<2>::Constant(std::numeric_limits<double>::quiet_NaN());

  for (const Matrix<2>& g : {inside_out, half_turn, not_a_number}) {
    const auto step = strain_increment<2>(f, g);

    CHECK_FALSE(step.admissible());
    CHECK(step.strain_increment.norm() == 0);
    CHECK(step.rotation_increment == Matrix<2>::Identity());
  }
  CHECK(strain_increment<2>(f, inside_out).volume_ratio == Approx(-0.5));
}

namespace
{

/// Simple shear of 1 while the particle turns by two radians, in `n` steps of g as the grid gives it: the increment of
/// the displacement over the shape at the start of the step. How far F and the strain are off.
struct ShearErrors {
  double deformation_gradient;
  double strain;
};

/// Reference: the strain of a simple shear that is turned as it goes, R^T D R integrated by Simpson's rule as above.
struct TurnedShear {
  static Matrix<2> turn(double angle) { return Eigen::Rotation2Dd(angle).toRotationMatrix(); }
  static Matrix<2> deformation(double t) { return turn(2 * t) * (Matrix<2>() << 1, t, 0, 1).finished(); }
  /// The rotation of F: the turn, and tan(angle) = -t / 2 of the shear.
  static Matrix<2> rotation(double t) { return turn(2 * t - std::atan(t / 2)); }
  static Matrix<2> rate(double t)
  {
    return turn(2 * t) * (Matrix<2>() << 0, 0.5, 0.5, 0).finished() * turn(2 * t).transpose();
  }
  static Matrix<2> strain()
  {
    constexpr int n = 2000;
    Matrix<2> sum = Matrix<2>::Zero();
    for (int i = 0; i <= n; ++i) {
      const double t = static_cast<double>(i) / n;
      const double weight = (i == 0 || i == n ? 1.0 : i % 2 == 1 ? 4.0 : 2.0) / (3.0 * n);
      sum += weight * rotation(t).transpose() * rate(t) * rotation(t);
    }
    return rotation(1) * sum * rotation(1).transpose();
  }
};

template <class Update>
ShearErrors shear_errors(int n)
{
  Matrix<2> f = Matrix<2>::Identity();
  SymmetricTensor<2> strain = SymmetricTensor<2>::Zero();
  for (int i = 0; i < n; ++i) {
    const Matrix<2> start = TurnedShear::deformation(static_cast<double>(i) / n);
    const Matrix<2> end = TurnedShear::deformation((i + 1.0) / n);
    const auto step = strain_increment<2, Update>(f, end * start.inverse() - Matrix<2>::Identity());
    strain = rotated<2>(strain, step.rotation_increment) + step.strain_increment;
    f = step.deformation_gradient;
  }
  return {(f - TurnedShear::deformation(1)).norm(), (plane_part<2>(strain) - TurnedShear::strain()).norm()};
}

template <class Update>
double order_of(double ShearErrors::*error)
{
  return std::log2(shear_errors<Update>(100).*error / shear_errors<Update>(200).*error);
}

}  // namespace

TEST_CASE("in a shear that turns the exact update is of second order and the others are of first")
{
  CHECK(shear_errors<ExactUpdate>(50).deformation_gradient < 1e-13);
  CHECK(shear_errors<FirstOrderUpdate>(50).deformation_gradient < 1e-13);
  CHECK(order_of<ExponentialUpdate>(&ShearErrors::deformation_gradient) == Approx(1).margin(0.02));

  CHECK(order_of<ExactUpdate>(&ShearErrors::strain) == Approx(2).margin(0.02));
  CHECK(order_of<FirstOrderUpdate>(&ShearErrors::strain) == Approx(1).margin(0.02));
  CHECK(order_of<ExponentialUpdate>(&ShearErrors::strain) == Approx(1).margin(0.02));
}

TEST_CASE("the exponential update has the determinant that the trace asks for and turns nothing inside out")
{
  const Matrix<2> f = (Matrix<2>() << 1.2, 0.1, -0.2, 0.7).finished();
  const Matrix<3> f_in_space = (Matrix<3>() << 1.2, 0.1, 0.3, -0.2, 0.7, 0, 0, 0.1, 1.1).finished();
  const Matrix<2> crushing = (Matrix<2>() << -2.5, 0.4, -0.3, -0.5).finished();
  const Matrix<3> turning = (Matrix<3>() << -0.9, 1, 0.5, -1.2, -0.4, 0.2, 0.3, -0.2, 0.1).finished();

  const auto plane = strain_increment<2, ExponentialUpdate>(f, crushing);
  const auto space = strain_increment<3, ExponentialUpdate>(f_in_space, turning);

  CHECK(plane.admissible());
  CHECK(plane.volume_ratio == Approx(std::exp(-3.0)).epsilon(1e-15));
  CHECK(plane.deformation_gradient.determinant() == Approx(std::exp(-3.0) * f.determinant()).epsilon(1e-13));
  CHECK(trace(plane.strain_increment) == Approx(-3.0).epsilon(1e-14));
  CHECK(space.volume_ratio == Approx(std::exp(-1.2)).epsilon(1e-15));
  CHECK(space.deformation_gradient.determinant() == Approx(std::exp(-1.2) * f_in_space.determinant()).epsilon(1e-13));
  CHECK(trace(space.strain_increment) == Approx(-1.2).epsilon(1e-14));
}

TEST_CASE("the exponential of a turning rate is the turn and that of a stretching rate the stretch")
{
  const double angle = 1.3;
  const Vector<3> axis = Vector<3>(1, 2, -2) / 3;
  const Matrix<3> turn = Eigen::AngleAxisd(angle, axis).toRotationMatrix();
  const Matrix<3> stretch = Vector<3>(0.7, -1.1, 0.4).asDiagonal();

  CHECK((exponential_of<3, double>(angle * cross_matrix(axis)) - turn).norm() < 1e-14);
  CHECK((exponential_of<3, double>(stretch).diagonal().array() - stretch.diagonal().array().exp()).matrix().norm() <
        1e-14);
}

TEST_CASE("a step too large for the exponential update is reported")
{
  const Matrix<2> turn = 4 * (Matrix<2>() << 0, -1, 1, 0).finished();

  CHECK_FALSE(strain_increment<2, ExponentialUpdate>(Matrix<2>::Identity(), turn).admissible());
}

}  // namespace test_strain_increment
