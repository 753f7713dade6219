#include <catch2/catch.hpp>

#include <cmath>

#include "components/contact/contact_table.hpp"
#include "components/errors.hpp"

namespace test_contact_table
{

using namespace tamp::components;

TEST_CASE("every pair has the coefficient it was given last, in either order")
{
  ContactTable table(3, 0.4);

  table.set(0, 2, 0.1);
  table.set(2, 1, ContactTable::no_slip);

  CHECK(table.friction(0, 1) == 0.4);
  CHECK(table.friction(1, 0) == 0.4);
  CHECK(table.friction(0, 2) == 0.1);
  CHECK(table.friction(2, 0) == 0.1);
  CHECK(std::isinf(table.friction(1, 2)));
}

TEST_CASE("coefficients below 0 and pairs that are none are refused")
{
  ContactTable table(2);

  CHECK_THROWS_AS(table.set(0, 1, -0.1), BadValue);
  CHECK_THROWS_AS(table.set(0, 1, std::nan("")), BadValue);
  CHECK_THROWS_AS(table.set(0, 2, 0.1), BadValue);
  CHECK_THROWS_AS(table.set(-1, 0, 0.1), BadValue);
  CHECK_THROWS_AS(table.set(1, 1, 0.1), BadValue);
  CHECK_THROWS_AS(ContactTable(0), BadValue);
  CHECK_THROWS_AS(ContactTable(2, -1), BadValue);
}

TEST_CASE("the normal of a pair is that of the flatter surface or of one of the two")
{
  ContactTable table(3);
  table.set(0, 2, 0.1, OwnNormal{2});

  CHECK(table.normal(0, 1) == ContactNormal(FlatterNormal()));
  CHECK(table.normal(0, 2) == ContactNormal(OwnNormal{2}));
  CHECK(table.normal(2, 0) == ContactNormal(OwnNormal{2}));
  CHECK_THROWS_AS(table.set(0, 1, 0.1, OwnNormal{2}), BadValue);
}

TEST_CASE("the surface of a group is needed unless each other group gives the normal of its pair with it")
{
  ContactTable table(3);
  table.set(0, 1, 0.1, OwnNormal{1});
  table.set(0, 2, 0.1, OwnNormal{2});
  table.set(1, 2, 0.1, OwnNormal{1});

  CHECK(!table.needs_surface_of(0));
  CHECK(table.needs_surface_of(1));
  CHECK(table.needs_surface_of(2));
  const auto shared = GENERATE(ContactNormal(FlatterNormal()), ContactNormal(RegressionNormal()));
  table.set(0, 2, 0.1, shared);
  CHECK(table.needs_surface_of(0));
  CHECK(!ContactTable(1).needs_surface_of(0));
}

}  // namespace test_contact_table
