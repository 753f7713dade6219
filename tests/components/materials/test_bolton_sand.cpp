#include "components/materials/bolton_sand.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "components/errors.hpp"
#include "tests/components/materials/one_particle.hpp"

namespace test_bolton_sand
{

using namespace tamp;
using namespace tamp::components;

namespace
{

using Sample = test::OneParticle<3, BoltonSand>;

constexpr double grains = 2650, e_min = 0.6, e_max = 1.0, critical = 32;

/// Sand of a relative density; with `stiffness` 100 it is next to rigid, so that all strain is plastic.
BoltonSand sand(double relative_density, double stiffness = 1)
{
  BoltonSand made{.grain_density = grains,
                  .e_min = e_min,
                  .e_max = e_max,
                  .critical_friction_angle = critical,
                  .shear_modulus_number = 125 * stiffness,
                  .poissons_ratio = 0.05};
  made.check();
  made.fill(grains / (1 + e_max - relative_density * (e_max - e_min)));
  made.choose_strength(false);
  return made;
}

Sample confined(double pressure)
{
  Sample sample;
  sample.stress = -isotropic<6>(pressure);
  return sample;
}

/// Shears in triaxial compression by an axial strain; the lateral strain is the one with which `held` of the stress
/// stays, found by bisection.
template <class Held>
void shear(const BoltonSand& material, double axial, const Held& held, Sample& sample)
{
  const double before = held(sample.stress);
  const auto after = [&](double lateral) {
    Sample trial = sample;
    trial.strain(material, (SymmetricTensor<3>() << -axial, lateral, lateral, 0, 0, 0).finished());
    return trial;
  };
  double low = -5 * axial, high = 20 * axial;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (held(after(middle).stress) < before ? low : high) = middle;
  }
  sample = after(0.5 * (low + high));
}

double mean(const SymmetricTensor<3>& stress)
{
  return trace(stress) / 3;
}
double lateral_stress(const SymmetricTensor<3>& stress)
{
  return stress[1];
}

/// The friction angle that a triaxial stress shows [degrees].
double friction_of(const SymmetricTensor<3>& stress)
{
  return std::asin((stress[1] - stress[0]) / -(stress[0] + stress[1])) * 180 / std::numbers::pi;
}

double relative_density(const BoltonSand& material, const Sample& sample)
{
  return (e_max - material.void_ratio(sample.state)) / (e_max - e_min);
}

}  // namespace

TEST_CASE("isotropic pressure of sand is the integral of a modulus that grows as its root, in one increment or many")
{
  const BoltonSand material = sand(0.5);
  const double e = 0.8, bulk_by_shear = 2 * 1.05 / (3 * 0.9);
  const double k = bulk_by_shear * 125 * std::sqrt(1e5) * (2.97 - e) * (2.97 - e) / (1 + e), floor = 10e3;
  const int n = GENERATE(1, 10, 1000);
  Sample sample;

  sample.strain(material, isotropic<6>(-0.004 / 3), n);

  // Below the floor K is constant.
  const double to_floor = std::sqrt(floor) / k, root = std::sqrt(floor) + 0.5 * k * (0.004 - to_floor);
  CHECK(sample.pressure() == Approx(root * root).epsilon(1e-12));
  CHECK(sample.bulk_modulus == Approx(k * root).epsilon(1e-12));
  CHECK(sample.shear_modulus == Approx(k * root / bulk_by_shear).epsilon(1e-12));
  sample.strain(material, isotropic<6>(0.004 / 3), n);
  CHECK(std::abs(sample.pressure()) < 1e-6);
}

TEST_CASE("sand without pressure that is not strained stays whole")
{
  const BoltonSand material = sand(0.5);
  Sample sample;

  for (int i = 0; i < 10; ++i) sample.strain(material, SymmetricTensor<3>::Zero());

  CHECK(sample.opening == 0);
  CHECK(sample.counts.separations == 0);
  CHECK(sample.bulk_modulus == material.initial_moduli().bulk_modulus);
}

TEST_CASE("strength of sand is Bolton's by density and pressure, and the critical one where it does not dilate")
{
  const double density = GENERATE(0.2, 0.5, 0.9), pressure = GENERATE(50e3, 400e3, 5e6);
  const BoltonSand material = sand(density, 100);
  Sample sample = confined(pressure);

  // So little that the density is that of the start.
  for (int i = 0; i < 50; ++i) shear(material, 1e-5, mean, sample);

  const double index = density * (10 - std::log(std::max(pressure / 1e3, 150.0))) - 1;
  const double expected = critical + 3 * std::clamp(index, 0.0, 4.0);
  CHECK(friction_of(sample.stress) == Approx(expected).epsilon(0.002));
  CHECK(material.dilatancy_index({}, pressure) == Approx(index));
}

TEST_CASE("sand sheared under constant pressure nears the density at which I_R is 0 by Bolton's rate")
{
  const double density = GENERATE(0.05, 0.9);
  const BoltonSand material = sand(density, 1000);
  const double logarithm = 10 - std::log(150.0), slope = 0.3 * logarithm / (e_max - e_min);
  const double critical_ratio = e_max - (e_max - e_min) / logarithm;
  // de / (1 + e) = D d(axial), D = slope (e_c - e): closed form.
  const auto void_ratio = [&](double axial) {
    const double from = e_max - density * (e_max - e_min), c = critical_ratio;
    const double decay = (from - c) / (1 + from) * std::exp(-slope * (1 + c) * axial);
    return (c + decay) / (1 - decay);
  };
  const auto error_of = [&](int n) {
    Sample sample = confined(100e3);
    for (int i = 0; i < n; ++i) shear(material, 0.4 / n, mean, sample);
    return std::abs(material.void_ratio(sample.state) - void_ratio(0.4));
  };

  const double coarse = error_of(200), fine = error_of(400);

  CAPTURE(coarse, fine, void_ratio(0.4), critical_ratio);
  CHECK(fine < 2e-3 * (e_max - e_min));
  CHECK(coarse / fine == Approx(2).epsilon(0.2));
}

TEST_CASE("loose and dense sand sheared under one cell pressure end at one density and the critical angle")
{
  for (const double density : {0.05, 0.9}) {
    const BoltonSand material = sand(density);
    Sample sample = confined(200e3);

    for (int i = 0; i < 6000; ++i) shear(material, 2e-4, lateral_stress, sample);

    const double expected = 1 / (10 - std::log(1e-3 * sample.pressure()));
    CAPTURE(density, sample.pressure());
    CHECK(relative_density(material, sample) == Approx(expected).epsilon(0.03));
    CHECK(friction_of(sample.stress) == Approx(critical).margin(0.3));
  }
}

TEST_CASE("sand sheared at constant volume ends at the pressure at which its density does not dilate")
{
  for (const double pressure : {0.3e6, 8e6}) {
    const BoltonSand material = sand(0.6);
    Sample sample = confined(pressure);

    for (int i = 0; i < 20'000; ++i) {
      sample.strain(material, (SymmetricTensor<3>() << -1e-4, 5e-5, 5e-5, 0, 0, 0).finished());
    }

    const double expected = 1e3 * std::exp(10 - 1 / relative_density(material, sample));
    CAPTURE(pressure);
    CHECK(sample.pressure() == Approx(expected).epsilon(0.01));
    CHECK(friction_of(sample.stress) == Approx(critical).margin(0.1));
  }
}

TEST_CASE("sand under more pressure than its grains bear is counted as out of range")
{
  const BoltonSand material = sand(0.9);
  CHECK(material.crushing_pressure() == Approx(1e3 * std::exp(9.0)));
  for (const double part : {0.99, 1.01}) {
    const double pressure = part * material.crushing_pressure();
    Sample sample = confined(pressure);
    sample.strain(material, SymmetricTensor<3>::Zero());
    CHECK(sample.counts.with_range == 1);
    CHECK(sample.counts.extrapolated == (part > 1 ? 1 : 0));
    CHECK(material.tested(sample.state, pressure) == (part > 1 ? Tested::beyond : Tested::within));
  }
}

TEST_CASE("sand may start settled as far as its strength at that density and pressure goes")
{
  const BoltonSand dense = sand(0.9), loose = sand(0.1);
  const auto settled = [](double across) {
    SymmetricTensor<3> stress = SymmetricTensor<3>::Zero();
    stress.head<3>() << -100e3, -across, -across;
    return SettledStress{stress, 100e3};
  };

  CHECK_NOTHROW(dense.settled_state(settled(20e3)));
  CHECK_THROWS_AS(loose.settled_state(settled(20e3)), BadValue);
  CHECK_NOTHROW(loose.settled_state(settled(35e3)));
  CHECK(dense.bulk_modulus({}, 400e3) == Approx(2 * dense.bulk_modulus({}, 100e3)));
}

TEST_CASE("a scene's kind gives the strength of sand that says none, and grains and density its void ratio")
{
  BoltonSand material = sand(0.5);
  CHECK(material.strength_per_index == 3);
  CHECK(material.initial_void_ratio == Approx(0.8));
  material.strength_per_index = 4;
  material.choose_strength(true);
  CHECK(material.strength_per_index == 4);
  material.strength_per_index = INFINITY;
  material.choose_strength(true);
  CHECK(material.strength_per_index == 5);
  CHECK_THROWS_WITH(material.fill(1200), Catch::Contains("a void ratio of 1.208; expected 1325 to 1656.2 kg/m^3"));
  CHECK_THROWS_AS(material.fill(1700), BadParameter);
  material.e_max = 0.6;
  CHECK_THROWS_WITH(material.check(), "0.6; expected below e_max, 0.6");
}

}  // namespace test_bolton_sand
