#include "components/materials/drucker_prager.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>
#include <random>

#include "components/errors.hpp"
#include "tests/components/materials/axial_strain.hpp"

namespace test_drucker_prager
{

using namespace tamp;
using namespace tamp::components;
using test::plane, test::strain_axially, test::triaxial;

namespace
{

constexpr double degree = std::numbers::pi / 180;

DruckerPrager soil(double friction, double dilation, double cohesion)
{
  return {.bulk_modulus = 200e6,
          .shear_modulus = 100e6,
          .friction_angle = friction,
          .dilation_angle = dilation,
          .cohesion = cohesion};
}

template <int D>
using Sample = test::OneParticle<D, DruckerPrager>;

template <int D>
Sample<D> confined(double pressure)
{
  return test::confined_particle<D, DruckerPrager>(pressure);
}

double slope(double angle)
{
  return 2 * std::sqrt(3.0) * std::sin(angle * degree) / (3 - std::sin(angle * degree));
}

}  // namespace

TEST_CASE("in triaxial compression soil has the strength of Mohr and Coulomb, and flows at its dilation angle")
{
  const double friction = GENERATE(0.0, 20.0, 35.0), cohesion = GENERATE(5e3, 40e3);
  const double dilation = GENERATE(0.0, 0.3) * friction, pressure = 100e3;
  const DruckerPrager material = soil(friction, dilation, cohesion);
  Sample<3> sample = confined<3>(pressure);

  for (int i = 0; i < 200; ++i) strain_axially(material, -1e-4, triaxial, sample);
  const double before = sample.state.plastic_volumetric;
  strain_axially(material, -1e-4, triaxial, sample);

  const double sine = std::sin(friction * degree), cosine = std::cos(friction * degree);
  const double strength = (2 * cohesion * cosine + 2 * pressure * sine) / (1 - sine);
  CHECK(sample.stress[1] - sample.stress[0] == Approx(strength).epsilon(1e-9));
  // Stress stands still, so that all strain is plastic: along s / (2 sqrt(J2)) + beta / 3, -1/sqrt(3) of it axial.
  const double beta = slope(dilation);
  CHECK(sample.state.plastic_volumetric - before ==
        Approx(1e-4 * beta / (beta / 3 - 1 / std::sqrt(3.0))).margin(1e-14));
}

TEST_CASE(
    "in plane strain soil has the strength and the dilation that follow from flow without strain out of the plane")
{
  const double friction = GENERATE(20.0, 35.0), dilation = GENERATE(0.0, 0.3, 1.0) * friction;
  const double cohesion = 10e3, pressure = 100e3;
  const DruckerPrager material = soil(friction, dilation, cohesion);
  Sample<2> sample = confined<2>(pressure);

  for (int i = 0; i < 2000; ++i) strain_axially(material, -2e-4, plane, sample);
  const double before = sample.state.plastic_volumetric;
  strain_axially(material, -2e-4, plane, sample);

  // Where elastic strain has come to rest the flow has no part along z: s_zz = -2/3 beta sqrt(J2). With r the radius
  // and m the middle of Mohr's circle in the plane, r = sqrt(1 - beta^2/3) (k + alpha m) / (1 - alpha beta / 3).
  const double alpha = slope(friction), beta = slope(dilation);
  const double k = cohesion * alpha / std::tan(friction * degree);
  const double part = std::sqrt(1 - beta * beta / 3) / (1 - alpha * beta / 3);
  const double radius = part * (k + alpha * pressure) / (1 - part * alpha);
  CHECK(0.5 * (sample.stress[1] - sample.stress[0]) == Approx(radius).epsilon(1e-6));
  const double axial = 0.5 * (beta - std::sqrt(1 - beta * beta / 3));
  CHECK(sample.state.plastic_volumetric - before == Approx(2e-4 * beta / axial).epsilon(1e-5).margin(1e-12));
}

TEST_CASE(
    "soil pulled apart and sheared bears the tension of its cut-off, or of the apex, and the shear the cone has there")
{
  const bool is_cut = GENERATE(true, false);
  DruckerPrager material = soil(30, 10, 10e3);
  if (is_cut) material.tension_cutoff = 4e3;
  Sample<3> sample;

  for (int i = 0; i < 10; ++i) {
    sample.strain(material, (SymmetricTensor<3>() << 1e-4, 1e-4, 1e-4, 2e-4, 0, 0).finished());
  }

  const double expected = is_cut ? 4e3 : 10e3 / std::tan(30 * degree);
  CHECK(sample.pressure() == Approx(-expected));
  CHECK(sample.sqrt_j2() == Approx(slope(30) * (10e3 / std::tan(30 * degree) - expected)).margin(1e-3));
  CHECK(material.apex_tension() == Approx(10e3 / std::tan(30 * degree)));
  // Beyond what the pull stored, all of it is plastic.
  CHECK(sample.state.plastic_volumetric == Approx(-(30e-4 - expected / 200e6)));
}

TEST_CASE("one increment along a straight path from a stress without shear gives what a thousand give")
{
  const DruckerPrager material = soil(30, 10, 10e3);
  const SymmetricTensor<3> strain = (SymmetricTensor<3>() << -0.003, 0.001, -0.001, 0.004, 0.001, -0.002).finished();
  Sample<3> once = confined<3>(50e3), often = confined<3>(50e3);

  once.strain(material, strain);
  often.strain(material, strain, 1000);

  CHECK((once.stress - often.stress).norm() < 1e-10 * once.stress.norm());
  CHECK(once.state.plastic_volumetric == Approx(often.state.plastic_volumetric));
  CHECK(once.state.plastic_volumetric < 0);
}

TEST_CASE("soil with next to no strength, and no friction, keeps a finite stress")
{
  std::mt19937_64 random(5);
  std::normal_distribution<double> any(0, 1);
  for (int i = 0; i < 1000; ++i) {
    Sample<3> sample;
    SymmetricTensor<3> strain;
    for (int k = 0; k < 6; ++k) strain[k] = 0.01 * any(random);
    sample.strain(soil(0, 0, 1e-12), strain);
    REQUIRE(sample.stress.allFinite());
    REQUIRE(sample.sqrt_j2() < 1e-6);
  }
}

TEST_CASE("soil without cohesion that is torn and sheared at once has no stress left")
{
  Sample<3> sample = confined<3>(1e3);

  sample.strain(soil(35, 0, 0), (SymmetricTensor<3>() << 0.01, 0.02, 0, 0.05, 0, 0.01).finished());

  CHECK(sample.stress.norm() < 1e-6);
}

TEST_CASE("soil ends inside the cone and the cut-off, its flow takes work, and elastic and plastic strain add up")
{
  std::mt19937_64 random(7);
  std::normal_distribution<double> any(0, 1);
  std::uniform_real_distribution<double> part(0, 1);
  for (int i = 0; i < 20'000; ++i) {
    DruckerPrager material = soil(5 + 40 * part(random), 0, 50e3 * part(random));
    material.dilation_angle = part(random) * material.friction_angle;
    material.tension_cutoff = part(random) * material.apex_tension();
    Sample<3> sample = confined<3>(100e3 * part(random));
    SymmetricTensor<3> strain;
    for (int k = 0; k < 6; ++k) strain[k] = 0.01 * any(random);
    const Sample<3> before = sample;

    sample.strain(material, strain);

    const double alpha = slope(material.friction_angle);
    const double k = material.cohesion * alpha / std::tan(material.friction_angle * degree);
    CAPTURE(i, sample.pressure(), sample.sqrt_j2());
    REQUIRE(sample.sqrt_j2() <= k + alpha * sample.pressure() + 1e-3);
    REQUIRE(sample.pressure() >= -material.tension_cutoff - 1e-3);
    REQUIRE(sample.plastic_work >= -1e-9);
    const SymmetricTensor<3> change = sample.stress - before.stress;
    const SymmetricTensor<3> plastic = strain - deviator(change) / (2 * material.shear_modulus) -
                                       isotropic<6>(trace(change) / (9 * material.bulk_modulus));
    REQUIRE(-trace(plastic) == Approx(sample.state.plastic_volumetric).margin(1e-12));
    const SymmetricTensor<3> shear = deviator(plastic);
    REQUIRE(std::sqrt(2.0 / 3.0 * double_dot(shear, shear)) == Approx(sample.state.equivalent_plastic).margin(1e-12));
    REQUIRE(double_dot(sample.stress, plastic) == Approx(sample.plastic_work).margin(1e-6));
  }
}

TEST_CASE("halving the increments of a path that turns halves soil's error")
{
  const DruckerPrager material = soil(30, 10, 10e3);
  const auto stress_after = [&](int n) {
    Sample<3> sample = confined<3>(50e3);
    for (int i = 0; i < n; ++i) {
      const double angle = std::numbers::pi * (i + 0.5) / n;
      const double normal = 0.02 / n * std::cos(angle), shear = 0.02 / n * std::sin(angle);
      sample.strain(material, (SymmetricTensor<3>() << -0.002 / n, normal, -normal, shear, 0, 0).finished());
    }
    return sample.stress;
  };
  const SymmetricTensor<3> exact = stress_after(1 << 16);

  const double coarse = (stress_after(64) - exact).norm(), fine = (stress_after(128) - exact).norm();

  CHECK(coarse < 0.05 * exact.norm());
  CHECK(coarse / fine == Approx(2).epsilon(0.15));
}

TEST_CASE("plane strain of soil is space without strain out of the plane")
{
  const DruckerPrager material = soil(30, 10, 10e3);
  Sample<2> flat = confined<2>(50e3);
  Sample<3> space = confined<3>(50e3);

  for (int i = 0; i < 100; ++i) {
    flat.strain(material, (SymmetricTensor<2>() << -1e-4, 5e-5, 0, 2e-4).finished());
    space.strain(material, (SymmetricTensor<3>() << -1e-4, 5e-5, 0, 2e-4, 0, 0).finished());
  }

  CHECK((flat.stress - space.stress.head<4>()).norm() < 1e-12 * space.stress.norm());
  CHECK(flat.state.plastic_volumetric == Approx(space.state.plastic_volumetric));
}

TEST_CASE("soil whose strain is no number keeps its stress, and says so")
{
  Sample<3> sample = confined<3>(1e3);

  const auto failure = sample.update(soil(30, 0, 0), isotropic<6>(NAN));

  REQUIRE(failure);
  CHECK(failure->fault == UpdateFault::not_finite);
  CHECK(sample.stress == confined<3>(1e3).stress);
  CHECK(sample.counts.failures == 1);
}

TEST_CASE("soil that would gain by flowing, that holds nothing, or bears more tension than its cone is refused")
{
  DruckerPrager material = soil(30, 10, 10e3);
  CHECK_NOTHROW(material.check());
  material.tension_cutoff = 17320.5;
  CHECK_NOTHROW(material.check());
  material.tension_cutoff = 20e3;
  CHECK_THROWS_WITH(material.check(), "20000; expected at most 17320.5 Pa, where the cone ends");
  CHECK_THROWS_AS(soil(30, 31, 0).check(), BadParameter);
  CHECK_THROWS_AS(soil(0, 0, 0).check(), BadParameter);
}

}  // namespace test_drucker_prager
