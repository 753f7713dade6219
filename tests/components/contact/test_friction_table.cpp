#include <catch2/catch.hpp>

#include <cmath>

#include "components/contact/friction_table.hpp"
#include "components/errors.hpp"

using namespace tamp::components;

TEST_CASE("every pair has the coefficient it was given last, in either order")
{
  FrictionTable friction(3, 0.4);

  friction.set(0, 2, 0.1);
  friction.set(2, 1, FrictionTable::no_slip);

  CHECK(friction(0, 1) == 0.4);
  CHECK(friction(1, 0) == 0.4);
  CHECK(friction(0, 2) == 0.1);
  CHECK(friction(2, 0) == 0.1);
  CHECK(std::isinf(friction(1, 2)));
}

TEST_CASE("coefficients below 0 and pairs that are none are refused")
{
  FrictionTable friction(2);

  CHECK_THROWS_AS(friction.set(0, 1, -0.1), BadValue);
  CHECK_THROWS_AS(friction.set(0, 1, std::nan("")), BadValue);
  CHECK_THROWS_AS(friction.set(0, 2, 0.1), BadValue);
  CHECK_THROWS_AS(friction.set(-1, 0, 0.1), BadValue);
  CHECK_THROWS_AS(friction.set(1, 1, 0.1), BadValue);
  CHECK_THROWS_AS(FrictionTable(0), BadValue);
  CHECK_THROWS_AS(FrictionTable(2, -1), BadValue);
}
