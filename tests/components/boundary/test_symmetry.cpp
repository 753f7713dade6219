#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <vector>

#include "components/boundary/symmetry.hpp"
#include "components/errors.hpp"

using namespace tamp;
using namespace tamp::components;

namespace
{

/// A 4 x 3 block, x fastest. The wall at x = node 1 has its ghosts at node 0 and mirrors node 2.
constexpr int n_x = 4, n_y = 3;

std::size_t at(int i, int j)
{
  return static_cast<std::size_t>(i + n_x * j);
}

std::vector<Vector<2>> numbered_vectors()
{
  std::vector<Vector<2>> field;
  for (int n = 0; n < n_x * n_y; ++n) field.push_back({n + 1, 100 * (n + 1)});
  return field;
}

}  // namespace

TEST_CASE("folding adds the ghost to its mirror node, the normal component reversed, and nothing else")
{
  const SymmetryWall<2> wall({n_x, n_y}, 0, 1, -1);
  std::vector<double> mass(n_x * n_y);
  for (std::size_t n = 0; n < mass.size(); ++n) mass[n] = static_cast<double>(n + 1);
  const auto mass_before = mass;
  auto momentum = numbered_vectors();
  const auto momentum_before = momentum;

  wall.fold(mass);
  wall.fold(momentum);

  for (int j = 0; j < n_y; ++j) {
    CHECK(mass[at(2, j)] == mass_before[at(2, j)] + mass_before[at(0, j)]);
    CHECK(momentum[at(2, j)][0] == momentum_before[at(2, j)][0] - momentum_before[at(0, j)][0]);
    CHECK(momentum[at(2, j)][1] == momentum_before[at(2, j)][1] + momentum_before[at(0, j)][1]);
    for (const int i : {0, 1, 3}) {
      CHECK(mass[at(i, j)] == mass_before[at(i, j)]);
      CHECK(momentum[at(i, j)] == momentum_before[at(i, j)]);
    }
  }
}

TEST_CASE("a velocity that grows linearly from the wall continues through it")
{
  const double spacing = 0.1, rate = 3;
  const SymmetryWall<2> wall({n_x, n_y}, 0, 1, -1);
  std::vector<Vector<2>> velocity(n_x * n_y), expected(n_x * n_y);
  for (int j = 0; j < n_y; ++j) {
    for (int i = 0; i < n_x; ++i) {
      expected[at(i, j)] = Vector<2>(rate * spacing * (i - 1), 7.0 + j);
      velocity[at(i, j)] = expected[at(i, j)];
    }
    velocity[at(0, j)] = Vector<2>(99, 99);
    velocity[at(1, j)][0] = 99;
  }

  wall.constrain_and_mirror(velocity);

  CHECK(velocity == expected);
}

TEST_CASE("a wall on the upper side looks the other way")
{
  const SymmetryWall<2> wall({n_x, n_y}, 1, 1, +1);
  auto field = numbered_vectors();
  const auto before = field;
  std::vector<double> scalar(n_x * n_y, 1);
  for (int i = 0; i < n_x; ++i) scalar[at(i, 0)] = 5;

  wall.constrain_and_mirror(field);
  wall.mirror(scalar);

  for (int i = 0; i < n_x; ++i) {
    CHECK(field[at(i, 0)] == before[at(i, 0)]);
    CHECK(field[at(i, 1)] == Vector<2>(before[at(i, 1)][0], 0));
    CHECK(field[at(i, 2)] == Vector<2>(before[at(i, 0)][0], -before[at(i, 0)][1]));
    CHECK(scalar[at(i, 2)] == 5);
    CHECK(scalar[at(i, 1)] == 1);
  }
}

TEST_CASE("in a corner the ghost reaches its image of an image, whichever wall comes first")
{
  const SymmetryWall<2> left({n_x, n_y}, 0, 1, -1), below({n_x, n_y}, 1, 1, -1);
  std::vector<Vector<2>> one(n_x * n_y, Vector<2>::Zero()), other = one;
  one[at(0, 0)] = other[at(0, 0)] = Vector<2>(3, 5);

  left.fold(one);
  below.fold(one);
  below.fold(other);
  left.fold(other);

  CHECK(one[at(2, 2)] == Vector<2>(-3, -5));
  CHECK(other[at(2, 2)] == Vector<2>(-3, -5));

  one = other = numbered_vectors();
  const Vector<2> inside = one[at(2, 2)];
  left.constrain_and_mirror(one);
  below.constrain_and_mirror(one);
  below.constrain_and_mirror(other);
  left.constrain_and_mirror(other);

  CHECK(one == other);
  CHECK(one[at(0, 0)] == -inside);
  CHECK(one[at(1, 1)] == Vector<2>(0, 0));
}

TEST_CASE("scattering a half body and folding gives the inside nodes what the whole body gives them")
{
  // Linear hats of half width 2 in one row: their support reaches one node beyond the wall, as GIMP's does.
  const std::array<int, 2> n_nodes{5, 3};  // nodes at x = -1 .. 3, the wall at x = 0
  const SymmetryWall<2> wall(n_nodes, 0, 1, -1);
  const auto scatter = [&](double x, const Vector<2>& momentum, std::vector<Vector<2>>& field) {
    for (int i = 0; i < 5; ++i) {
      const double distance = std::abs(x - (i - 1));
      if (distance < 2) field[static_cast<std::size_t>(i + 5)] += (2 - distance) / 4 * momentum;
    }
  };
  std::vector<Vector<2>> half(15, Vector<2>::Zero()), whole = half;
  for (const double x : {0.25, 0.75, 1.25}) {
    scatter(x, {2 + x, 3 * x}, half);
    scatter(x, {2 + x, 3 * x}, whole);
    scatter(-x, {-(2 + x), 3 * x}, whole);
  }

  wall.fold(half);

  for (std::size_t i = 7; i < 10; ++i) CHECK((half[i] - whole[i]).norm() < 1e-15);
  CHECK(half[6][1] == Approx(whole[6][1] / 2));
  CHECK(whole[6][0] == Approx(0).margin(1e-15));
}

TEST_CASE("in space every node of the wall has its ghost and its mirror")
{
  const std::array<int, 3> n_nodes{3, 4, 5};
  const int axis = GENERATE(0, 1, 2);
  const SymmetryWall<3> wall(n_nodes, axis, 1, -1);
  const auto place = [&](int i, int j, int k) { return static_cast<std::size_t>(i + 3 * (j + 4 * k)); };
  std::vector<Vector<3>> field(60);
  for (std::size_t n = 0; n < 60; ++n) field[n] = Vector<3>(1, 2, 3) * static_cast<double>(n + 1);
  const auto before = field;

  wall.constrain_and_mirror(field);

  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        std::array<int, 3> mirror{i, j, k};
        const auto along = static_cast<std::size_t>(axis);
        Vector<3> expected = before[place(i, j, k)];
        if (mirror[along] == 0) {
          mirror[along] = 2;
          expected = before[place(mirror[0], mirror[1], mirror[2])];
          expected[axis] *= -1;
        } else if (mirror[along] == 1) {
          expected[axis] = 0;
        }
        CHECK(field[place(i, j, k)] == expected);
      }
    }
  }
}

TEST_CASE("a wall without a node layer on each side is refused")
{
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 0, 0, -1), BadValue);
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 0, 3, 1), BadValue);
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 2, 1, 1), BadValue);
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 0, 1, 0), BadValue);
}
