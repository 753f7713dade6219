#include <catch2/catch.hpp>

#include <array>
#include <cmath>
#include <vector>

#include "components/boundary/symmetry.hpp"
#include "components/errors.hpp"

namespace test_symmetry
{

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

/// A field value with a scalar and a vector part.
template <int D>
struct Value {
  double scalar = 0;
  Vector<D> vector = Vector<D>::Zero();

  void hold_on_mirror(int axis) { vector[axis] = 0; }
  Value mirrored(int axis) const
  {
    Value image = *this;
    image.vector[axis] *= -1;
    return image;
  }
  Value& operator+=(const Value& other)
  {
    scalar += other.scalar;
    vector += other.vector;
    return *this;
  }
  friend bool operator==(const Value& a, const Value& b) { return a.scalar == b.scalar && a.vector == b.vector; }
};

std::vector<Value<2>> numbered()
{
  std::vector<Value<2>> field;
  field.reserve(static_cast<std::size_t>(n_x * n_y));
  for (int n = 0; n < n_x * n_y; ++n) field.push_back({0.5 * (n + 1), {n + 1, 100 * (n + 1)}});
  return field;
}

}  // namespace

TEST_CASE("folding adds the mirrored ghost to its mirror node and holds the wall, and does nothing else")
{
  const SymmetryWall<2> wall({n_x, n_y}, 0, 1, -1);
  auto field = numbered();
  const auto before = field;

  wall.fold(field.data());

  for (int j = 0; j < n_y; ++j) {
    const Value<2>& ghost = before[at(0, j)];
    const Value<2>& inside = before[at(2, j)];
    CHECK(field[at(2, j)].scalar == inside.scalar + ghost.scalar);
    CHECK(field[at(2, j)].vector == Vector<2>(inside.vector[0] - ghost.vector[0], inside.vector[1] + ghost.vector[1]));
    CHECK(field[at(1, j)].scalar == before[at(1, j)].scalar);
    CHECK(field[at(1, j)].vector == Vector<2>(0, before[at(1, j)].vector[1]));
    for (const int i : {0, 3}) CHECK(field[at(i, j)] == before[at(i, j)]);
  }
}

TEST_CASE("a velocity that grows linearly from the wall continues through it")
{
  const double spacing = 0.1, rate = 3;
  const SymmetryWall<2> wall({n_x, n_y}, 0, 1, -1);
  std::vector<Value<2>> velocity(n_x * n_y), expected(n_x * n_y);
  for (int j = 0; j < n_y; ++j) {
    for (int i = 0; i < n_x; ++i) {
      expected[at(i, j)].vector = Vector<2>(rate * spacing * (i - 1), 7.0 + j);
      velocity[at(i, j)] = expected[at(i, j)];
    }
    velocity[at(0, j)].vector = Vector<2>(99, 99);
    velocity[at(1, j)].vector[0] = 99;
  }

  wall.constrain(velocity.data());
  wall.mirror(velocity.data());

  CHECK(velocity == expected);
}

TEST_CASE("a wall on the upper side looks the other way")
{
  const SymmetryWall<2> wall({n_x, n_y}, 1, 1, +1);
  auto field = numbered();
  const auto before = field;

  wall.constrain(field.data());
  wall.mirror(field.data());

  for (int i = 0; i < n_x; ++i) {
    CHECK(field[at(i, 0)] == before[at(i, 0)]);
    CHECK(field[at(i, 1)].vector == Vector<2>(before[at(i, 1)].vector[0], 0));
    CHECK(field[at(i, 2)] == before[at(i, 0)].mirrored(1));
  }
}

TEST_CASE("in a corner the ghost reaches its image of an image, whichever wall comes first")
{
  const SymmetryWall<2> left({n_x, n_y}, 0, 1, -1), below({n_x, n_y}, 1, 1, -1);
  std::vector<Value<2>> one(n_x * n_y);
  one[at(0, 0)].vector = Vector<2>(3, 5);
  auto other = one;

  left.fold(one.data());
  below.fold(one.data());
  below.fold(other.data());
  left.fold(other.data());

  CHECK(one[at(2, 2)].vector == Vector<2>(-3, -5));
  CHECK(other[at(2, 2)].vector == Vector<2>(-3, -5));

  one = other = numbered();
  const Vector<2> inside = one[at(2, 2)].vector;
  left.constrain(one.data());
  left.mirror(one.data());
  below.constrain(one.data());
  below.mirror(one.data());
  below.constrain(other.data());
  below.mirror(other.data());
  left.constrain(other.data());
  left.mirror(other.data());

  CHECK(one == other);
  CHECK(one[at(0, 0)].vector == -inside);
  CHECK(one[at(1, 1)].vector == Vector<2>(0, 0));
}

TEST_CASE("scattering a half body and folding gives the inside nodes what the whole body gives them")
{
  // Linear hats of half width 2 in one row: their support reaches one node beyond the wall, as GIMP's does.
  const std::array<int, 2> n_nodes{5, 3};  // nodes at x = -1 .. 3, the wall at x = 0
  const SymmetryWall<2> wall(n_nodes, 0, 1, -1);
  const auto scatter = [&](double x, const Vector<2>& momentum, std::vector<Value<2>>& field) {
    for (int i = 0; i < 5; ++i) {
      const double distance = std::abs(x - (i - 1));
      if (distance < 2) field[static_cast<std::size_t>(i + 5)].vector += (2 - distance) / 4 * momentum;
    }
  };
  std::vector<Value<2>> half(15), whole = half;
  for (const double x : {0.25, 0.75, 1.25}) {
    scatter(x, {2 + x, 3 * x}, half);
    scatter(x, {2 + x, 3 * x}, whole);
    scatter(-x, {-(2 + x), 3 * x}, whole);
  }

  wall.fold(half.data());

  for (std::size_t i = 7; i < 10; ++i) CHECK((half[i].vector - whole[i].vector).norm() < 1e-15);
  CHECK(half[6].vector[1] == Approx(whole[6].vector[1] / 2));
  CHECK(half[6].vector[0] == 0);
  CHECK(whole[6].vector[0] == Approx(0).margin(1e-15));
}

TEST_CASE("in space every node of the wall has its ghost and its mirror")
{
  const std::array<int, 3> n_nodes{3, 4, 5};
  const int axis = GENERATE(0, 1, 2);
  const SymmetryWall<3> wall(n_nodes, axis, 1, -1);
  const auto place = [&](int i, int j, int k) { return static_cast<std::size_t>(i + 3 * (j + 4 * k)); };
  std::vector<Value<3>> field(60);
  for (std::size_t n = 0; n < 60; ++n) field[n].vector = Vector<3>(1, 2, 3) * static_cast<double>(n + 1);
  const auto before = field;

  wall.constrain(field.data());
  wall.mirror(field.data());

  for (int k = 0; k < 5; ++k) {
    for (int j = 0; j < 4; ++j) {
      for (int i = 0; i < 3; ++i) {
        std::array<int, 3> mirror{i, j, k};
        const auto along = static_cast<std::size_t>(axis);
        Value<3> expected = before[place(i, j, k)];
        if (mirror[along] == 0) {
          mirror[along] = 2;
          expected = before[place(mirror[0], mirror[1], mirror[2])].mirrored(axis);
        } else if (mirror[along] == 1) {
          expected.vector[axis] = 0;
        }
        CHECK(field[place(i, j, k)] == expected);
      }
    }
  }
}

TEST_CASE("where walls meet each node has the inverse mass that it has in the whole, in any order of the walls")
{
  const std::array<SymmetryWall<2>, 2> walls{SymmetryWall<2>({3, 3}, 0, 1, -1), SymmetryWall<2>({3, 3}, 1, 1, -1)};
  const int first = GENERATE(0, 1);
  // x fastest; ghosts at 0, the walls at 1.
  std::array<double, 9> inverse_mass{9, 9, 9, 9, 4, 2, 9, 2, 1};

  walls[static_cast<std::size_t>(first)].complete_inverse_masses(inverse_mass.data());
  walls[static_cast<std::size_t>(1 - first)].complete_inverse_masses(inverse_mass.data());

  CHECK(inverse_mass == std::array<double, 9>{1, 1, 1, 1, 1, 1, 1, 1, 1});
}

TEST_CASE("a wall without a node layer on each side is refused")
{
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 0, 0, -1), BadValue);
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 0, 3, 1), BadValue);
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 2, 1, 1), BadValue);
  CHECK_THROWS_AS(SymmetryWall<2>({4, 3}, 0, 1, 0), BadValue);
}

}  // namespace test_symmetry
