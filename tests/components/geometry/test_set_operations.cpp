#include <catch2/catch.hpp>

#include <cmath>
#include <numbers>
#include <random>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/geometry/cone.hpp"
#include "components/geometry/fill.hpp"
#include "components/geometry/rotations.hpp"
#include "components/geometry/set_operations.hpp"
#include "components/geometry/transformed.hpp"

namespace test_set_operations
{

using namespace tamp;
using namespace tamp::components;

namespace
{

constexpr double pi = std::numbers::pi;

const Solid<3> cube(Box<3>{{0, 0, 0}, {1, 1, 1}});
const Solid<3> ball(Ball<3>{{1, 1, 1}, 0.8});

}  // namespace

TEST_CASE("sets of solids hold what the words say")
{
  const Solid<3> either(Union<3>{{cube, ball}}), both(Intersection<3>{{cube, ball}});
  const Solid<3> without(Difference<3>{cube, {ball}});
  std::mt19937 engine(4);
  std::uniform_real_distribution<double> coordinate(-0.5, 2);
  bool agree = true;

  for (int i = 0; i < 20000; ++i) {
    const Vector<3> x(coordinate(engine), coordinate(engine), coordinate(engine));
    const bool in_cube = (x.array() > 0).all() && (x.array() < 1).all();
    const bool in_ball = (x - Vector<3>(1, 1, 1)).norm() < 0.8;
    agree = agree && either.contains(x) == (in_cube || in_ball) && both.contains(x) == (in_cube && in_ball) &&
            without.contains(x) == (in_cube && !in_ball);
  }

  CHECK(agree);
}

TEST_CASE("volumes of sets of solids lie within their stated errors of the closed forms")
{
  const double eighth = 4.0 / 3 * pi * std::pow(0.8, 3) / 8;
  const auto within = [](const Volume& volume, double exact) {
    CHECK_FALSE(volume.is_exact());
    CHECK(volume.error < 2e-3 * exact);
    // Twice the standard error is exceeded now and then; four times is not.
    CHECK(std::abs(volume.value - exact) < 2 * volume.error);
  };

  within(Union<3>{{cube, ball}}.volume(), 1 + 7 * eighth);
  within(Intersection<3>{{cube, ball}}.volume(), eighth);
  within(Difference<3>{cube, {ball}}.volume(), 1 - eighth);
  const Solid<2> square(Box<2>{{0, 0}, {1, 1}}), disk(Ball<2>{{1, 0}, 0.5});
  within(Difference<2>{square, {disk}}.volume(), 1 - pi / 16);
}

TEST_CASE("the volume of solids whose boxes are apart or only touch is exact")
{
  const Solid<3> beside(Box<3>{{1, 0, 0}, {2, 1, 1}}), far(Ball<3>{{5, 5, 5}, 1});

  const Volume volume = Union<3>{{cube, beside, far}}.volume();

  CHECK(volume.is_exact());
  CHECK(volume.value == Approx(2 + 4.0 / 3 * pi));
  CHECK(Difference<3>{cube, {beside, far}}.volume().value == 1);
  CHECK(Intersection<3>{{cube, far}}.volume().value == 0);
}

TEST_CASE("the box of a set of solids is that of its parts")
{
  CHECK(Solid<3>(Union<3>{{cube, ball}}).bounding_box().upper == Vector<3>(1.8, 1.8, 1.8));
  CHECK(Solid<3>(Intersection<3>{{cube, ball}}).bounding_box().lower.isApprox(Vector<3>(0.2, 0.2, 0.2)));
  CHECK(Solid<3>(Difference<3>{cube, {ball}}).bounding_box().upper == Vector<3>(1, 1, 1));
}

TEST_CASE("a set of no solids is refused")
{
  CHECK_THROWS_AS(Solid<3>(Union<3>{}), BadValue);
  CHECK_THROWS_AS(Solid<2>(Intersection<2>{}), BadValue);
}

TEST_CASE("a solid is turned first and then moved")
{
  // A quarter turn about z takes (1..3, 0..1) to (-1..0, 1..3).
  const Solid<3> bar(Box<3>{{1, 0, 0}, {3, 1, 1}});
  const Solid<3> moved(Transformed<3>{bar, axis_rotation({0, 0, 2}, pi / 2), {10, 0, 5}});

  CHECK(moved.contains({9.5, 2.9, 5.5}));
  CHECK_FALSE(moved.contains({9.5, 3.1, 5.5}));
  CHECK_FALSE(moved.contains({10.1, 2, 5.5}));
  CHECK(moved.bounding_box().lower.isApprox(Vector<3>(9, 1, 5)));
  CHECK(moved.bounding_box().upper.isApprox(Vector<3>(10, 3, 6)));
  CHECK(moved.volume().value == 2);
  CHECK(moved.volume().is_exact());
}

TEST_CASE("the box of a turned solid is as tight as that of the solid itself")
{
  const Matrix<3> tilt = axis_rotation({1, 1, 0}, 0.7);
  const Vector<3> first(0.1, 0, 0), second(0.3, 1, 0.2);
  const Solid<3> turned(Transformed<3>{Solid<3>(Cylinder{first, second, 0.2}), tilt, {0, 0, 1}});
  const Solid<3> built_there(Cylinder{tilt * first + Vector<3>(0, 0, 1), tilt * second + Vector<3>(0, 0, 1), 0.2});

  CHECK(turned.bounding_box().lower.isApprox(built_there.bounding_box().lower));
  CHECK(turned.bounding_box().upper.isApprox(built_there.bounding_box().upper));
}

TEST_CASE("a turn that is none is refused")
{
  CHECK_THROWS_AS(axis_rotation({0, 0, 0}, 1), BadValue);
  CHECK_THROWS_AS(Solid<3>(Transformed<3>{cube, 2 * Matrix<3>::Identity(), {0, 0, 0}}), BadValue);
}

TEST_CASE("particles hold the volume of a solid the better the finer they are")
{
  const Solid<3> shell(Difference<3>{Solid<3>(Ball<3>{{0.5, 0.5, 0.5}, 0.45}),
                                     {Solid<3>(Cone{{0.5, 0.5, 0}, {0.5, 0.5, 1}, 0.3, 0.1})}});
  const double volume = shell.volume().value;
  const auto error = [&](int n_cells) {
    const ParticleLattice<3> lattice{{0, 0, 0}, 1.0 / n_cells, 2};
    const auto x = fill(shell, lattice, CellRange<3>{{0, 0, 0}, {n_cells, n_cells, n_cells}});
    return std::abs(static_cast<double>(x.size()) * lattice.particle_volume() / volume - 1);
  };

  CHECK(error(10) < 5e-2);
  CHECK(error(40) < 2e-3);
}

}  // namespace test_set_operations
