#include "components/loads/local_damping.hpp"

#include <catch2/catch.hpp>

namespace test_local_damping
{

using namespace tamp::components;
using tamp::Vector;

TEST_CASE("local damping takes a part of what speeds up, and adds it to what slows down")
{
  CHECK(damped_change<3>({1, -1, 2}, {4, -4, -4}, 0.25).isApprox(Vector<3>(3, -3, -5), 1e-15));
}

TEST_CASE("local damping leaves what is at rest alone")
{
  CHECK(damped_change<2>({0, 0}, {4, -4}, 0.25) == Vector<2>(4, -4));
  CHECK(damped_change<2>({1, 1}, {0, 0}, 0.25) == Vector<2>(0, 0));
}

}  // namespace test_local_damping
