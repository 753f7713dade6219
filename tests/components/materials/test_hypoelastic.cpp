#include "components/materials/hypoelastic.hpp"

#include <catch2/catch.hpp>

#include "components/materials/wave_speed.hpp"
#include "tests/components/materials/one_particle.hpp"

namespace test_hypoelastic
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a hypoelastic solid stretched in one direction only carries M along it and lambda across")
{
  const Hypoelastic solid{9, 3};
  test::OneParticle<2, Hypoelastic> particle;
  particle.stress = (SymmetricTensor<2>() << 1, 1, 1, 1).finished();

  particle.strain(solid, (SymmetricTensor<2>() << 0.1, 0, 0, 0.2).finished());

  // M = K + 4G/3 = 13, lambda = K - 2G/3 = 7
  CHECK(particle.stress[0] == Approx(1 + 1.3));
  CHECK(particle.stress[1] == Approx(1 + 0.7));
  CHECK(particle.stress[2] == Approx(1 + 0.7));
  CHECK(particle.stress[3] == Approx(1 + 1.2));
  CHECK(particle.bulk_modulus == 9);
  CHECK(particle.shear_modulus == 3);
}

TEST_CASE("the dilatational wave of steel runs at about 5.9 km/s")
{
  CHECK(wave_speed(166e9, 79e9, 7850) == Approx(5878).epsilon(1e-3));
}

}  // namespace test_hypoelastic
