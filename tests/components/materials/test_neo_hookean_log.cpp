#include "components/materials/neo_hookean_log.hpp"

#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <cstdlib>

#include "components/errors.hpp"
#include "tests/components/materials/one_particle.hpp"
#include "tests/components/materials/stress_of_energy.hpp"

namespace test_neo_hookean_log
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double G = 3, lambda = 7, K = lambda + 2.0 / 3.0 * G;
const NeoHookeanLog log_solid{K, G};

template <int D>
test::OneParticle<D, NeoHookeanLog> answer_to(const Matrix<D>& f)
{
  test::OneParticle<D, NeoHookeanLog> particle{.deformation_gradient = f};
  particle.strain(log_solid, SymmetricTensor<D>::Zero());
  return particle;
}

double log_energy(const Matrix<3>& f)
{
  const double log_J = std::log(f.determinant());
  return 0.5 * G * (f.squaredNorm() - 3) - G * log_J + 0.5 * lambda * log_J * log_J;
}

/// Stretched, sheared and turned all at once.
Matrix<3> some_deformation()
{
  return (Matrix<3>() << 1.2, -0.3, 0.2, 0.4, 0.8, 0.1, -0.2, 0.5, 1.4).finished();
}

Matrix<3> without_stretch_along_z(const Matrix<2>& f)
{
  Matrix<3> padded = Matrix<3>::Identity();
  padded.topLeftCorner<2, 2>() = f;
  return padded;
}

/// The second derivative by s of the energy per current volume in the motion (1 + s h) F, by differences.
double modulus_of(const Matrix<3>& f, const Matrix<3>& h)
{
  const double s = 1e-4;
  const auto at = [&](double amount) { return log_energy((Matrix<3>::Identity() + amount * h) * f) / f.determinant(); };
  return (at(s) - 2 * at(0) + at(-s)) / (s * s);
}

/// rho c^2 of the fastest of many waves, all directions and polarisations.
double fastest_wave_modulus(const Matrix<3>& f)
{
  std::srand(1);
  double fastest = 0;
  for (int i = 0; i < 4000; ++i) {
    const Eigen::Vector3d n = Eigen::Vector3d::Random().normalized();
    const Eigen::Vector3d a = i % 2 == 0 ? n : Eigen::Vector3d::Random().normalized();
    fastest = std::max(fastest, modulus_of(f, a * n.transpose()));
  }
  return fastest;
}

}  // namespace

TEST_CASE("a logarithmic solid stores the energy of its law, in the plane as in space")
{
  const Matrix<2> f = (Matrix<2>() << 1.3, 0.4, -0.2, 0.8).finished();

  CHECK(log_solid.stored_energy<3>(some_deformation()) == Approx(log_energy(some_deformation())));
  CHECK(log_solid.stored_energy<2>(f) == Approx(log_energy(without_stretch_along_z(f))));
  CHECK(log_solid.stored_energy<3>(Matrix<3>::Identity()) == 0);
}

TEST_CASE("the stress of a logarithmic solid is the derivative of its energy")
{
  const Matrix<3> f = some_deformation();

  const Matrix<3> kirchhoff = f.determinant() * plane_part<3>(answer_to<3>(f).stress);

  CHECK((test::stress_of_energy(log_energy, f) - kirchhoff).norm() < 1e-8 * kirchhoff.norm());
}

TEST_CASE("a logarithmic solid stretched along one axis has the stress of its closed form")
{
  const double stretch = GENERATE(0.4, 1.0, 1.8);
  const Matrix<2> f = (Matrix<2>() << stretch, 0, 0, 1).finished();

  const SymmetricTensor<2> stress = answer_to<2>(f).stress;

  CHECK(stress[0] == Approx(lambda * std::log(stretch) / stretch + G * (stretch - 1 / stretch)).margin(1e-14));
  CHECK(stress[1] == Approx(lambda * std::log(stretch) / stretch).margin(1e-14));
  CHECK(stress[2] == Approx(lambda * std::log(stretch) / stretch).margin(1e-14));
  CHECK(stress[3] == 0);
}

TEST_CASE("a logarithmic solid in simple shear has G gamma of shear stress and G gamma^2 along the shear alone")
{
  const double gamma = 0.7;
  Matrix<3> f = Matrix<3>::Identity();
  f(0, 1) = gamma;

  const SymmetricTensor<3> stress = answer_to<3>(f).stress;

  CHECK(stress[3] == Approx(G * gamma));
  CHECK(stress[0] == Approx(G * gamma * gamma));
  CHECK(std::abs(stress[1]) < 1e-14);
  CHECK(std::abs(stress[2]) < 1e-14);
}

TEST_CASE("the stress of a logarithmic solid turns with a rotation laid over its deformation")
{
  const Matrix<3> f = some_deformation();
  const Matrix<3> r = Eigen::AngleAxisd(1.1, Eigen::Vector3d(1, -2, 0.5).normalized()).toRotationMatrix();

  CHECK((answer_to<3>(r * f).stress - rotated<3>(answer_to<3>(f).stress, r)).norm() < 1e-13 * G);
}

TEST_CASE("a logarithmic solid under small strains is that of Hooke")
{
  const double size = 1e-6;
  const SymmetricTensor<3> strain = size * (SymmetricTensor<3>() << 0.5, -1, 0.8, 0.3, -0.6, 0.2).finished();

  const SymmetricTensor<3> stress = answer_to<3>(Matrix<3>::Identity() + plane_part<3>(strain)).stress;

  const SymmetricTensor<3> expected = isotropic<6>(K * trace(strain)) + 2 * G * deviator(strain);
  CHECK((stress - expected).norm() < 10 * size * expected.norm());
}

TEST_CASE("plane strain of a logarithmic solid is space without stretch along z")
{
  const Matrix<2> f = (Matrix<2>() << 1.2, 0.5, -0.3, 0.8).finished();

  const auto plane = answer_to<2>(f);
  const auto space = answer_to<3>(without_stretch_along_z(f));

  CHECK((plane.stress - space.stress.head<4>()).norm() < 1e-14 * G);
  CHECK(plane.bulk_modulus == Approx(space.bulk_modulus));
  CHECK(plane.shear_modulus == Approx(space.shear_modulus));
  CHECK(tangent_moduli<2>(log_solid, f).bulk_modulus == Approx(plane.bulk_modulus));
  CHECK(tangent_moduli<2>(log_solid, f).shear_modulus == Approx(plane.shear_modulus));
}

TEST_CASE("the tangent moduli of an unstrained logarithmic solid are its own")
{
  const TangentModuli moduli = tangent_moduli<3>(log_solid, Matrix<3>::Identity());

  CHECK(moduli.bulk_modulus == Approx(K));
  CHECK(moduli.shear_modulus == Approx(G));
}

TEST_CASE("no wave and no equal strain of a strained logarithmic solid is stiffer than its tangent moduli say")
{
  const auto stretches = GENERATE(Eigen::Vector3d(1, 1, 1), Eigen::Vector3d(0.4, 0.4, 0.4), Eigen::Vector3d(3, 1, 1),
                                  Eigen::Vector3d(0.2, 1, 1), Eigen::Vector3d(2, 2, 0.3), Eigen::Vector3d(4, 0.5, 0.5),
                                  Eigen::Vector3d(2, 2, 2), Eigen::Vector3d(3, 3, 1));
  const Matrix<3> f = stretches.asDiagonal();
  const TangentModuli moduli = tangent_moduli<3>(log_solid, f);
  const double bound = moduli.bulk_modulus + 4.0 / 3.0 * moduli.shear_modulus;

  const double fastest = fastest_wave_modulus(f);

  CHECK(fastest <= bound * (1 + 1e-5));
  // A bound that is far too high would make steps needlessly short.
  CHECK(fastest > 0.6 * bound);
  if (stretches.prod() <= 1) CHECK(fastest > 0.99 * bound);
  // An equal strain of D axes has D^2 times the modulus of the viscous rule, K_t + (2/D - 2/3) G_t.
  const Matrix<3> in_plane = Eigen::Vector3d(1, 1, 0).asDiagonal();
  CHECK(modulus_of(f, Matrix<3>::Identity()) <= 9 * moduli.bulk_modulus * (1 + 1e-5));
  CHECK(modulus_of(f, in_plane) <= 4 * (moduli.bulk_modulus + moduli.shear_modulus / 3) * (1 + 1e-5));
}

TEST_CASE("a logarithmic solid of a Poisson's ratio below 0 is refused")
{
  CHECK_THROWS_AS((NeoHookeanLog{0.6 * G, G}.check()), BadParameter);
  CHECK_NOTHROW(NeoHookeanLog{0.6666666 * G, G}.check());
}

}  // namespace test_neo_hookean_log
