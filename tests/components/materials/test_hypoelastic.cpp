#include "components/materials/hypoelastic.hpp"

#include <catch2/catch.hpp>

#include "components/errors.hpp"
#include "components/materials/wave_speed.hpp"

using namespace tamp;
using namespace tamp::components;

TEST_CASE("a hypoelastic solid stretched in one direction only carries M along it and lambda across")
{
  const Hypoelastic solid{9, 3};
  const std::vector<SymmetricTensor<2>> strain{(SymmetricTensor<2>() << 0.1, 0, 0, 0.2).finished()};
  std::vector<SymmetricTensor<2>> stress{(SymmetricTensor<2>() << 1, 1, 1, 1).finished()};

  update<2>(solid, strain, stress);

  // M = K + 4G/3 = 13, lambda = K - 2G/3 = 7
  CHECK(stress[0][0] == Approx(1 + 1.3));
  CHECK(stress[0][1] == Approx(1 + 0.7));
  CHECK(stress[0][2] == Approx(1 + 0.7));
  CHECK(stress[0][3] == Approx(1 + 1.2));
}

TEST_CASE("a hypoelastic solid without stiffness is refused")
{
  CHECK_THROWS_AS(check(Hypoelastic{0, 1}), BadValue);
  CHECK_THROWS_AS(check(Hypoelastic{1, -1}), BadValue);
  CHECK_NOTHROW(check(Hypoelastic{140e9, 80e9}));
}

TEST_CASE("the dilatational wave of steel runs at about 5.9 km/s")
{
  CHECK(wave_speed(166e9, 79e9, 7850) == Approx(5878).epsilon(1e-3));
}
