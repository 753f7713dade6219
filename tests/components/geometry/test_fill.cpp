#include <catch2/catch.hpp>

#include <vector>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/geometry/fill.hpp"
#include "components/geometry/rotations.hpp"

namespace test_fill
{

using namespace tamp;
using namespace tamp::components;

TEST_CASE("particles stand at the centres of equal shares of a cell, x fastest, cell by cell")
{
  const Solid<2> everything(Box<2>{{0, 0}, {100, 100}});
  const ParticleLattice<2> lattice{{10, 20}, 2.0, 2};

  const auto x = fill(everything, lattice, CellRange<2>{{0, 0}, {2, 1}});

  const std::vector<Vector<2>> expected{{10.5, 20.5}, {11.5, 20.5}, {10.5, 21.5}, {11.5, 21.5},
                                        {12.5, 20.5}, {13.5, 20.5}, {12.5, 21.5}, {13.5, 21.5}};
  CHECK(x == expected);
  CHECK(lattice.particle_volume() == 1.0);
}

TEST_CASE("a box of whole cells is filled with its whole volume")
{
  const ParticleLattice<3> lattice{{0.3, -0.7, 0.1}, 0.1, 2};
  const Solid<3> box(Box<3>{{0.4, -0.6, 0.1}, {0.7, -0.2, 0.6}});

  const auto x = fill(box, lattice, CellRange<3>{{0, 0, 0}, {10, 10, 10}});

  CHECK(x.size() == 3 * 4 * 5 * 8);
  CHECK(static_cast<double>(x.size()) * lattice.particle_volume() == Approx(box.volume().value));
}

TEST_CASE("patches that share out the cells make the particles of the whole, none twice and none lost")
{
  const ParticleLattice<3> lattice{{0.01, 0.02, -0.03}, 0.1, 3};
  const Solid<3> ball(Ball<3>{{0.5, 0.4, 0.45}, 0.317});

  const auto whole = fill(ball, lattice, CellRange<3>{{0, 0, 0}, {9, 9, 9}});
  auto parts = fill(ball, lattice, CellRange<3>{{0, 0, 0}, {9, 9, 4}});
  const auto upper = fill(ball, lattice, CellRange<3>{{0, 0, 4}, {9, 9, 9}});
  parts.insert(parts.end(), upper.begin(), upper.end());

  CHECK(whole == parts);
  CHECK(static_cast<double>(whole.size()) * lattice.particle_volume() == Approx(ball.volume().value).epsilon(0.02));
}

TEST_CASE("filling finds every site that the solid contains and no other")
{
  const ParticleLattice<2> lattice{{-1, -1}, 0.25, 3};
  const Solid<2> block(RotatedBox<2>{{0.1, 0.05}, {1.1, 0.6}, plane_rotation<2>(0.5)});
  std::vector<Vector<2>> expected;
  for (int j = 0; j < 8; ++j) {
    for (int i = 0; i < 8; ++i) {
      for (int site = 0; site < 9; ++site) {
        const int column = site % 3, row = site / 3;
        const Vector<2> x(-1 + 0.25 * (i + (column + 0.5) / 3), -1 + 0.25 * (j + (row + 0.5) / 3));
        if (block.contains(x)) expected.push_back(x);
      }
    }
  }

  const auto x = fill(block, lattice, CellRange<2>{{0, 0}, {8, 8}});

  CHECK(expected.size() > 50);
  REQUIRE(x.size() == expected.size());
  for (std::size_t p = 0; p < x.size(); ++p) CHECK((x[p] - expected[p]).norm() < 1e-15);
}

TEST_CASE("cells outside the solid, or no cells, give no particles")
{
  const ParticleLattice<2> lattice{{0, 0}, 1.0, 2};
  const Solid<2> far(Box<2>{{1e12, 1e12}, {2e12, 2e12}});
  const Solid<2> here(Box<2>{{0, 0}, {4, 4}});

  CHECK(fill(far, lattice, CellRange<2>{{0, 0}, {4, 4}}).empty());
  CHECK(fill(here, lattice, CellRange<2>{{2, 2}, {2, 4}}).empty());
  CHECK(fill(here, lattice, CellRange<2>{{5, 5}, {9, 9}}).empty());
}

TEST_CASE("a lattice without cells or sites is refused")
{
  const Solid<2> here(Box<2>{{0, 0}, {4, 4}});
  const CellRange<2> cells{{0, 0}, {4, 4}};

  CHECK_THROWS_AS(fill(here, ParticleLattice<2>{{0, 0}, 0.0, 2}, cells), BadValue);
  CHECK_THROWS_AS(fill(here, ParticleLattice<2>{{0, 0}, 1.0, 0}, cells), BadValue);
}

}  // namespace test_fill
