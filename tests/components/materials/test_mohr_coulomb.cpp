#include "components/materials/mohr_coulomb.hpp"

#include <Eigen/Eigenvalues>
#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "components/errors.hpp"
#include "tests/components/materials/axial_strain.hpp"

namespace test_mohr_coulomb
{

using namespace tamp;
using namespace tamp::components;
using test::plane, test::strain_axially, test::triaxial;

namespace
{

constexpr double degree = std::numbers::pi / 180;

MohrCoulomb soil(double friction, double dilation, double cohesion)
{
  return {.bulk_modulus = 200e6,
          .shear_modulus = 100e6,
          .friction_angle = friction,
          .dilation_angle = dilation,
          .cohesion = cohesion};
}

template <int D>
using Sample = test::OneParticle<D, MohrCoulomb>;

template <int D>
Sample<D> confined(double pressure)
{
  return test::confined_particle<D, MohrCoulomb>(pressure);
}

/// The greater principal stress over a lesser one at failure, both compression positive, without cohesion.
double ratio_at_failure(double friction)
{
  return (1 + std::sin(friction * degree)) / (1 - std::sin(friction * degree));
}

/// The trial stress of a random stress and strain.
struct Trial {
  Sample<3> before;
  SymmetricTensor<3> strain;

  SymmetricTensor<3> stress(const MohrCoulomb& material) const
  {
    return before.stress + 2 * material.shear_modulus * deviator(strain) +
           isotropic<6>(material.bulk_modulus * trace(strain));
  }
};

Trial random_trial(std::mt19937_64& random)
{
  std::normal_distribution<double> any(0, 1);
  std::uniform_real_distribution<double> part(0, 1);
  Trial trial{confined<3>(300e3 * part(random)), {}};
  const double size = part(random) < 0.5 ? 1e-3 : 1e-2;
  for (int k = 0; k < 6; ++k) trial.strain[k] = size * any(random);
  // Triaxial trials end on edges.
  if (part(random) < 0.3) trial.strain = triaxial(size * any(random), size * any(random));
  return trial;
}

Vector<3> principal(const SymmetricTensor<3>& a)
{
  return Eigen::SelfAdjointEigenSolver<Matrix<3>>(plane_part<3>(a)).eigenvalues().reverse();
}

/// How far a stress is beyond the strength [Pa].
double beyond(const MohrCoulomb& material, const SymmetricTensor<3>& stress)
{
  const double sine = std::sin(material.friction_angle * degree), cosine = std::cos(material.friction_angle * degree);
  const Vector<3> s = principal(stress);
  return (s[0] - s[2]) + (s[0] + s[2]) * sine - 2 * material.cohesion * cosine;
}

}  // namespace

TEST_CASE("in triaxial compression and extension soil has Mohr and Coulomb's strength, and flows at its dilation angle")
{
  const double friction = GENERATE(0.0, 20.0, 35.0), cohesion = GENERATE(5e3, 40e3);
  const double dilation = GENERATE(0.0, 0.3) * friction, pressure = 100e3, sign = GENERATE(-1, 1);
  const MohrCoulomb material = soil(friction, dilation, cohesion);
  Sample<3> sample = confined<3>(pressure);

  for (int i = 0; i < 200; ++i) strain_axially(material, sign * 1e-4, triaxial, sample);
  const double before = sample.state.plastic_volumetric;
  strain_axially(material, sign * 1e-4, triaxial, sample);

  const double ratio = sign < 0 ? ratio_at_failure(friction) : 1 / ratio_at_failure(friction);
  const double from_cohesion = -sign * 2 * cohesion * std::sqrt(ratio);
  CHECK(-sample.stress[0] == Approx(ratio * pressure + from_cohesion).epsilon(1e-9));
  // All strain is plastic: the greater principal one over the two others as the flow has it.
  const double flow = ratio_at_failure(dilation), lateral = sign < 0 ? -0.5 * flow : -0.5 / flow;
  CHECK(before - sample.state.plastic_volumetric == Approx(sign * 1e-4 * (1 + 2 * lateral)).margin(1e-14));
}

TEST_CASE("in plane strain soil has the same strength, whatever its dilation, and without friction Tresca's")
{
  const double friction = GENERATE(0.0, 20.0, 35.0), dilation = GENERATE(0.0, 0.3, 1.0) * friction;
  const double cohesion = 10e3, pressure = 100e3;
  const MohrCoulomb material = soil(friction, dilation, cohesion);
  Sample<2> sample = confined<2>(pressure);

  for (int i = 0; i < 200; ++i) strain_axially(material, -2e-4, plane, sample);
  const double before = sample.state.plastic_volumetric;
  strain_axially(material, -2e-4, plane, sample);

  const double ratio = ratio_at_failure(friction);
  CHECK(-sample.stress[0] == Approx(ratio * pressure + 2 * cohesion * std::sqrt(ratio)).epsilon(1e-9));
  CHECK(before - sample.state.plastic_volumetric == Approx(2e-4 * (ratio_at_failure(dilation) - 1)).margin(1e-13));
}

TEST_CASE("of all stresses within the strength, associated flow ends at the one nearest to the trial")
{
  std::mt19937_64 random(11);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 5'000; ++i) {
    const double friction = 5 + 40 * part(random);
    const MohrCoulomb material = soil(friction, friction, 50e3 * part(random));
    const Trial trial = random_trial(random);
    Sample<3> sample = trial.before, other = random_trial(random).before;
    sample.strain(material, trial.strain);
    other.strain(material, random_trial(random).strain);

    // (trial - ended) : C : (any within - ended) <= 0.
    const SymmetricTensor<3> lost = trial.stress(material) - sample.stress;
    const SymmetricTensor<3> plastic =
        deviator(lost) / (2 * material.shear_modulus) + isotropic<6>(trace(lost) / (9 * material.bulk_modulus));
    CAPTURE(i, sample.stress.transpose());
    REQUIRE(beyond(material, sample.stress) <= 1e-9 * (1e5 + sample.stress.norm()));
    REQUIRE(double_dot(plastic, SymmetricTensor<3>(other.stress - sample.stress)) <= 1e-6);
  }
}

TEST_CASE("flow at another angle is that of the planes on which the stress ends, and none pulls")
{
  std::mt19937_64 random(13);
  std::uniform_real_distribution<double> part(0, 1);
  std::array<int, 3> n_of_kind{};
  for (int i = 0; i < 20'000; ++i) {
    const double friction = 5 + 40 * part(random);
    const MohrCoulomb material = soil(friction, part(random) * friction, 50e3 * part(random));
    const Trial trial = random_trial(random);
    Sample<3> sample = trial.before;
    sample.strain(material, trial.strain);
    if (!(beyond(material, trial.stress(material)) > 1)) continue;

    // Plastic strain has the axes of the trial, and its values in the same order.
    const Vector<3> from = principal(trial.stress(material)), to = principal(sample.stress);
    const Vector<3> lost = from - to;
    const double mean = lost.mean();
    const Vector<3> plastic = (lost.array() - mean) / (2 * material.shear_modulus) + mean / (3 * material.bulk_modulus);
    const double up = 1 + std::sin(material.dilation_angle * degree), down = 2 - up;
    const double near = 1e-9 * (1e5 + to.norm()), small = 1e-12 + 1e-7 * plastic.norm();
    CAPTURE(i, from.transpose(), to.transpose(), plastic.transpose());
    REQUIRE(sample.plastic_work >= -1e-9);
    const bool upper = to[0] - to[1] < near, lower = to[1] - to[2] < near;
    if (upper && lower) {
      ++n_of_kind[0];
      REQUIRE(to.mean() == Approx(material.apex_tension()).margin(near));
    } else {
      ++n_of_kind[upper || lower ? 1 : 2];
      REQUIRE(beyond(material, sample.stress) == Approx(0).margin(near));
      // By the parts of the two planes at most: a of the first and third, b of the other.
      REQUIRE(plastic[0] >= -small);
      REQUIRE(plastic[2] <= small);
      if (!lower) REQUIRE(plastic[1] >= -small);
      if (!upper) REQUIRE(plastic[1] <= small);
      const double raised = plastic[0] + std::max(plastic[1], 0.0), lowered = plastic[2] + std::min(plastic[1], 0.0);
      REQUIRE(raised * down == Approx(-lowered * up).margin(2 * small));
    }
  }
  for (const int n : n_of_kind) CHECK(n > 500);
}

TEST_CASE("elastic and plastic strain of Mohr and Coulomb's soil add up, and their work is counted")
{
  std::mt19937_64 random(7);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 5'000; ++i) {
    MohrCoulomb material = soil(5 + 40 * part(random), 0, 50e3 * part(random));
    material.dilation_angle = part(random) * material.friction_angle;
    material.tension_cutoff = part(random) * material.apex_tension();
    const Trial trial = random_trial(random);
    Sample<3> sample = trial.before;
    sample.strain(material, trial.strain);

    const SymmetricTensor<3> change = sample.stress - trial.before.stress;
    const SymmetricTensor<3> plastic = trial.strain - deviator(change) / (2 * material.shear_modulus) -
                                       isotropic<6>(trace(change) / (9 * material.bulk_modulus));
    const SymmetricTensor<3> shear = deviator(plastic);
    CAPTURE(i, sample.stress.transpose());
    REQUIRE(beyond(material, sample.stress) <= 1e-9 * (1e5 + sample.stress.norm()));
    REQUIRE(sample.pressure() >= -material.tension_cutoff - 1e-3);
    REQUIRE(-trace(plastic) == Approx(sample.state.plastic_volumetric).margin(1e-12));
    REQUIRE(std::sqrt(2.0 / 3.0 * double_dot(shear, shear)) == Approx(sample.state.equivalent_plastic).margin(1e-12));
    REQUIRE(double_dot(sample.stress, plastic) == Approx(sample.plastic_work).margin(1e-6));
  }
}

TEST_CASE("one increment of Mohr and Coulomb's soil along a straight path gives what a thousand give")
{
  const MohrCoulomb material = soil(30, 10, 10e3);
  const SymmetricTensor<3> strain = triaxial(-0.003, 0.001);
  Sample<3> once = confined<3>(50e3), often = confined<3>(50e3);

  once.strain(material, strain);
  often.strain(material, strain, 1000);

  CHECK((once.stress - often.stress).norm() < 1e-10 * once.stress.norm());
  CHECK(once.state.plastic_volumetric == Approx(often.state.plastic_volumetric));
}

TEST_CASE("plane strain of Mohr and Coulomb's soil is space without strain out of the plane")
{
  const MohrCoulomb material = soil(30, 10, 10e3);
  Sample<2> flat = confined<2>(50e3);
  Sample<3> space = confined<3>(50e3);

  for (int i = 0; i < 100; ++i) {
    flat.strain(material, (SymmetricTensor<2>() << -1e-4, 5e-5, 0, 2e-4).finished());
    space.strain(material, (SymmetricTensor<3>() << -1e-4, 5e-5, 0, 2e-4, 0, 0).finished());
  }

  CHECK((flat.stress - space.stress.head<4>()).norm() < 1e-12 * space.stress.norm());
  CHECK(flat.state.plastic_volumetric == Approx(space.state.plastic_volumetric));
}

TEST_CASE("soil widens by its dilation angle up to its limit, and no further")
{
  MohrCoulomb material = soil(35, 15, 0);
  material.dilation_limit = 0.02;
  Sample<3> sample = confined<3>(100e3);

  for (int i = 0; i < 3000; ++i) strain_axially(material, -1e-4, triaxial, sample);
  const double end = -sample.state.plastic_volumetric;
  for (int i = 0; i < 1000; ++i) strain_axially(material, -1e-4, triaxial, sample);

  CHECK(end == Approx(0.02).margin(1e-4));
  CHECK(-sample.state.plastic_volumetric == Approx(end).epsilon(1e-9));
}

TEST_CASE("soil of Mohr and Coulomb may start settled as far as its strength goes")
{
  const MohrCoulomb material = soil(30, 0, 0);
  const auto settled = [](double across) {
    SymmetricTensor<3> stress = SymmetricTensor<3>::Zero();
    stress.head<3>() << -100e3, -across, -across;
    return SettledStress{stress, 100e3};
  };

  CHECK(material.poisson_ratio() == Approx(2.0 / 7));
  CHECK_NOTHROW(material.settled_state(settled(100e3 / 3)));
  CHECK_NOTHROW(material.settled_state(settled(300e3)));
  CHECK_THROWS_WITH(material.settled_state(settled(30e3)),
                    "1e+05 Pa beside 3e+04 Pa across it; expected at most the "
                    "strength there, 9e+04 Pa; \"k0\", such as 0.5, gives another stress across");
  CHECK_THROWS_AS(material.settled_state(settled(310e3)), BadValue);
}

TEST_CASE("numbers of Mohr and Coulomb's soil that do not go together are refused")
{
  MohrCoulomb material = soil(30, 10, 10e3);
  CHECK_NOTHROW(material.check());
  material.tension_cutoff = 20e3;
  CHECK_THROWS_WITH(material.check(), "20000; expected at most 17320.5 Pa, where the cone ends");
  CHECK_THROWS_AS(soil(30, 31, 0).check(), BadParameter);
  CHECK_THROWS_AS(soil(0, 0, 0).check(), BadParameter);
}

}  // namespace test_mohr_coulomb
