#include <catch2/catch.hpp>
#include <cmath>

#include "tests/components/materials/one_particle.hpp"

namespace test_gaps
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double K = 20e6, G = 12e6;

template <class Soil>
Soil soil(double dilation, double cohesion)
{
  Soil material{.bulk_modulus = K, .shear_modulus = G, .friction_angle = 35};
  material.dilation_angle = dilation;
  material.cohesion = cohesion;
  material.separation = true;
  return material;
}

SymmetricTensor<3> along_x(double strain)
{
  return (SymmetricTensor<3>() << strain, 0, 0, 0, 0, 0).finished();
}

}  // namespace

TEMPLATE_TEST_CASE("soil that is stretched and pushed back keeps no gap, and bears nothing", "", DruckerPrager,
                   MohrCoulomb)
{
  const TestType material = soil<TestType>(GENERATE(0.0, 10.0), 0);
  test::OneParticle<3, TestType> sample;

  sample.strain(material, along_x(0.1), 1000);
  CHECK(sample.opening == Approx(0.1));
  CHECK(sample.bulk_modulus == 0);
  CHECK(sample.counts.separations == 1);
  sample.strain(material, along_x(-0.1), 1000);
  sample.strain(material, along_x(-1e-4));
  // The last increment may only be to close what round-off left.
  sample.strain(material, along_x(-1e-4));

  CHECK(sample.opening == 0);
  CHECK(sample.bulk_modulus == K);
  CHECK(std::abs(sample.state.plastic_volumetric) < 2e-4);
  CHECK(sample.pressure() == Approx(1e-4 * K).epsilon(0.01));
}

TEMPLATE_TEST_CASE("soil without separation keeps what it is stretched by as plastic volume", "", DruckerPrager,
                   MohrCoulomb)
{
  TestType material = soil<TestType>(0, 0);
  material.separation = false;
  test::OneParticle<3, TestType> sample;

  sample.strain(material, along_x(0.1), 1000);
  sample.strain(material, along_x(-0.1), 1000);

  CHECK(sample.pressure() > 1e6);
}

TEMPLATE_TEST_CASE("what shear widens soil by is no gap", "", DruckerPrager, MohrCoulomb)
{
  const TestType material = soil<TestType>(10, 0);
  test::OneParticle<3, TestType> sample;
  sample.stress = -isotropic<6>(100e3);

  sample.strain(material, (SymmetricTensor<3>() << 0, 0, 0, 0.05, 0, 0).finished(), 1000);

  CHECK(sample.opening == 0);
  CHECK(sample.state.plastic_volumetric < -1e-3);
  CHECK(sample.pressure() > 100e3);
}

TEMPLATE_TEST_CASE("soil with cohesion loses all stress as it parts, and its energy becomes plastic", "", DruckerPrager,
                   MohrCoulomb)
{
  TestType material = soil<TestType>(0, 10e3);
  material.tension_cutoff = 2e3;
  test::OneParticle<3, TestType> sample;
  double work = 0, plastic = 0;
  const auto strain = [&](double volumetric, int n) {
    for (int i = 0; i < n; ++i) {
      const SymmetricTensor<3> old = sample.stress, increment = isotropic<6>(volumetric / (3 * n));
      sample.strain(material, increment);
      work += 0.5 * double_dot(SymmetricTensor<3>(old + sample.stress), increment);
      plastic += sample.plastic_work;
    }
  };

  strain(0.999 * 2e3 / K, 100);
  CHECK(plastic == 0);
  CHECK(work == Approx(0.5 * 0.999 * 0.999 * 2e3 * 2e3 / K));
  strain(0.01 * 2e3 / K, 10);

  CHECK(sample.counts.separations == 1);
  CHECK(sample.stress.norm() == 0);
  CHECK(plastic == Approx(work).epsilon(1e-12));
  strain(0.05, 100);
  strain(-0.05, 100);
  CHECK(plastic == Approx(work).epsilon(1e-12));
}

TEMPLATE_TEST_CASE("soil that meets again in the middle of an increment takes the rest of it as compaction", "",
                   DruckerPrager, MohrCoulomb)
{
  const TestType material = soil<TestType>(0, 0);
  test::OneParticle<3, TestType> sample;

  sample.strain(material, isotropic<6>(1e-3));
  sample.strain(material, isotropic<6>(-1.5e-3));

  CHECK(sample.opening == 0);
  CHECK(sample.stress.norm() == 0);
  CHECK(sample.state.plastic_volumetric == Approx(1.5e-3));
  CHECK(sample.plastic_work == 0);
}

TEST_CASE("plane strain of soil with gaps is space without strain out of the plane")
{
  const auto material = soil<DruckerPrager>(0, 0);
  test::OneParticle<2, DruckerPrager> flat;
  test::OneParticle<3, DruckerPrager> space;

  for (const double strain : {1e-3, -2e-4, -9e-4, -1e-3}) {
    flat.strain(material, (SymmetricTensor<2>() << strain, 0, 0, 1e-4).finished());
    space.strain(material, (SymmetricTensor<3>() << strain, 0, 0, 1e-4, 0, 0).finished());
  }

  CHECK(flat.stress.isApprox(space.stress.head<4>(), 1e-14));
  CHECK(flat.pressure() > 1e4);
  CHECK(flat.opening == space.opening);
}

}  // namespace test_gaps
