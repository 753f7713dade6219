#include "components/materials/neo_hookean.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "tests/components/materials/one_particle.hpp"
#include "tests/components/materials/stress_of_energy.hpp"

namespace test_neo_hookean
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double K = 9, G = 3;
const NeoHookean solid{K, G};

template <int D>
SymmetricTensor<D> stress_of(const Matrix<D>& f)
{
  test::OneParticle<D, NeoHookean> particle{.deformation_gradient = f};
  particle.strain(solid, SymmetricTensor<D>::Zero());
  return particle.stress;
}

double energy(const Matrix<3>& f)
{
  const double J = f.determinant();
  return 0.5 * K * (0.5 * (J * J - 1) - std::log(J)) + 0.5 * G * (std::pow(J, -2.0 / 3.0) * f.squaredNorm() - 3);
}

/// Stretched, sheared and turned all at once.
Matrix<3> any_deformation()
{
  return (Matrix<3>() << 1.3, 0.4, -0.2, 0.1, 0.7, 0.3, -0.5, 0.2, 1.1).finished();
}

Matrix<3> in_space(const Matrix<2>& f)
{
  Matrix<3> padded = Matrix<3>::Identity();
  padded.topLeftCorner<2, 2>() = f;
  return padded;
}

/// rho c^2 / a.a of the wave (a, n), by second differences of the energy per current volume.
double wave_modulus(const Matrix<3>& f, const Eigen::Vector3d& a, const Eigen::Vector3d& n)
{
  const double s = 1e-4;
  const auto at = [&](double amount) {
    return energy((Matrix<3>::Identity() + amount * a * n.transpose()) * f) / f.determinant();
  };
  return (at(s) - 2 * at(0) + at(-s)) / (s * s);
}

}  // namespace

TEST_CASE("a neo-Hookean solid stores the energy of its law, in the plane as in space")
{
  const Matrix<2> f = (Matrix<2>() << 1.3, 0.4, -0.2, 0.8).finished();

  CHECK(solid.stored_energy<3>(any_deformation()) == Approx(energy(any_deformation())));
  CHECK(solid.stored_energy<2>(f) == Approx(energy(in_space(f))));
  CHECK(solid.stored_energy<3>(Matrix<3>::Identity()) == 0);
}

TEST_CASE("a neo-Hookean solid stretched in one direction only has the stress of its closed form")
{
  const double stretch = GENERATE(0.5, 1.0, 1.7);
  const Matrix<2> f = (Matrix<2>() << stretch, 0, 0, 1).finished();

  const SymmetricTensor<2> stress = stress_of<2>(f);

  const double volumetric = 0.5 * K * (stretch - 1 / stretch);
  const double deviatoric = G * std::pow(stretch, -5.0 / 3.0) * (stretch * stretch - 1) / 3;
  CHECK(stress[0] == Approx(volumetric + 2 * deviatoric).margin(1e-15));
  CHECK(stress[1] == Approx(volumetric - deviatoric).margin(1e-15));
  CHECK(stress[2] == Approx(volumetric - deviatoric).margin(1e-15));
  CHECK(stress[3] == 0);
}

TEST_CASE("a neo-Hookean solid in simple shear has G gamma of shear stress and normal stresses of second order")
{
  const double gamma = 0.8;
  Matrix<3> f = Matrix<3>::Identity();
  f(0, 1) = gamma;

  const SymmetricTensor<3> stress = stress_of<3>(f);

  CHECK(stress[3] == Approx(G * gamma));
  CHECK(stress[0] == Approx(G * gamma * gamma * 2 / 3));
  CHECK(stress[1] == Approx(-G * gamma * gamma / 3));
  CHECK(stress[2] == Approx(-G * gamma * gamma / 3));
  CHECK(std::abs(trace(stress)) < 1e-14);
}

TEST_CASE("a neo-Hookean solid under equal stretches has pressure only")
{
  const double stretch = GENERATE(0.6, 1.4);
  const double J = stretch * stretch * stretch;

  const SymmetricTensor<3> stress = stress_of<3>(stretch * Matrix<3>::Identity());

  CHECK((stress - isotropic<6>(0.5 * K * (J - 1 / J))).norm() < 1e-14 * K);
}

TEST_CASE("the stress of a neo-Hookean solid turns with a rotation laid over its deformation")
{
  const Matrix<3> f = any_deformation();
  const Matrix<3> r = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();

  CHECK((stress_of<3>(r * f) - rotated<3>(stress_of<3>(f), r)).norm() < 1e-13 * G);
}

TEST_CASE("the stress of a neo-Hookean solid is the derivative of its energy")
{
  const Matrix<3> f = any_deformation();

  const Matrix<3> kirchhoff = f.determinant() * plane_part<3>(stress_of<3>(f));

  CHECK((test::stress_of_energy(energy, f) - kirchhoff).norm() < 1e-8 * kirchhoff.norm());
}

TEST_CASE("plane strain of a neo-Hookean solid is space without stretch along z")
{
  const Matrix<2> f = (Matrix<2>() << 1.2, 0.5, -0.3, 0.8).finished();

  const SymmetricTensor<2> plane = stress_of<2>(f);
  const SymmetricTensor<3> space = stress_of<3>(in_space(f));

  CHECK((plane - space.head<4>()).norm() < 1e-14 * G);
  const TangentModuli flat = tangent_moduli<2>(solid, f), full = tangent_moduli<3>(solid, in_space(f));
  CHECK(flat.bulk_modulus == Approx(full.bulk_modulus));
  CHECK(flat.shear_modulus == Approx(full.shear_modulus));
}

TEST_CASE("the tangent moduli of an unstrained neo-Hookean solid are its own")
{
  const TangentModuli moduli = tangent_moduli<3>(solid, Matrix<3>::Identity());

  CHECK(moduli.bulk_modulus == Approx(K));
  CHECK(moduli.shear_modulus == Approx(G));
}

TEST_CASE("no wave of a strained neo-Hookean solid is faster than its tangent moduli say")
{
  const auto stretches = GENERATE(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0.4, 0.4, 0.4), Eigen::Vector3d(3, 1, 1),
                                  Eigen::Vector3d(0.2, 1, 1), Eigen::Vector3d(2, 2, 0.3), Eigen::Vector3d(4, 0.5, 0.5));
  const Matrix<3> f = stretches.asDiagonal();
  const TangentModuli moduli = tangent_moduli<3>(solid, f);
  const double bound = moduli.bulk_modulus + 4.0 / 3.0 * moduli.shear_modulus;

  std::srand(1);
  double fastest = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d n = Eigen::Vector3d::Random().normalized();
    const Eigen::Vector3d a = i % 2 == 0 ? n : Eigen::Vector3d::Random().normalized();
    fastest = std::max(fastest, wave_modulus(f, a, n));
  }

  CHECK(fastest <= bound * (1 + 1e-5));
  // A bound that is far too high would make steps needlessly short.
  CHECK(fastest > 0.6 * bound);
}

}  // namespace test_neo_hookean
