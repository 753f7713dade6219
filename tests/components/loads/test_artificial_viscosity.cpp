#include <catch2/catch.hpp>

#include "components/loads/artificial_viscosity.hpp"

namespace test_artificial_viscosity
{

using namespace tamp::components;

TEST_CASE("artificial viscosity of a closing cell is the linear and the quadratic term")
{
  const ArtificialViscosity viscosity{0.2, 2};

  // c_b = sqrt(9e6 / 1) = 3000 and |Dkk| h = 50 * 0.01 = 0.5.
  const double q = viscosity.pressure<double>(1, 9e6, -50, 0.01);

  CHECK(q == Approx(1 * (0.2 * 3000 * 0.5 + 2 * 0.25)));
}

TEST_CASE("the terms of artificial viscosity are the first and second power of the rate")
{
  const ArtificialViscosity only_linear{0.2, 0}, only_quadratic{0, 10};

  CHECK(only_linear.pressure<double>(1600, 4e8, -200, 0.002) ==
        Approx(2 * only_linear.pressure<double>(1600, 4e8, -100, 0.002)));
  CHECK(only_quadratic.pressure<double>(1600, 4e8, -200, 0.002) == Approx(1600 * 10 * 0.4 * 0.4));
}

TEST_CASE("there is no artificial viscosity in expansion or at rest")
{
  const ArtificialViscosity viscosity;

  CHECK(viscosity.pressure<double>(1600, 4e8, 100, 0.01) == 0);
  CHECK(viscosity.pressure<double>(1600, 4e8, 0, 0.01) == 0);
}

}  // namespace test_artificial_viscosity
