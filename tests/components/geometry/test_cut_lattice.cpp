#include "components/geometry/cut_lattice.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <numbers>

#include "components/errors.hpp"
#include "components/geometry/ball.hpp"
#include "components/geometry/box.hpp"
#include "components/geometry/set_operations.hpp"

namespace test_cut_lattice
{

using namespace tamp;
using namespace tamp::components;

namespace
{

template <int D>
CellRange<D> cells(int n)
{
  CellRange<D> range;
  range.lower.fill(0);
  range.upper.fill(n);
  return range;
}

template <int D>
Site<D> whole(const std::vector<Site<D>>& sites)
{
  Site<D> sum{Vector<D>::Zero(), 0};
  for (const Site<D>& site : sites) {
    sum.place += site.volume * site.place;
    sum.volume += site.volume;
  }
  sum.place /= sum.volume;
  return sum;
}

template <int D>
ParticleLattice<D> unit_lattice(int n_per_axis)
{
  return {Vector<D>::Zero(), 1.0, n_per_axis};
}

}  // namespace

TEMPLATE_TEST_CASE_SIG("a box along the lattice has the lattice's particles, bit for bit", "", ((int D), D), 2, 3)
{
  const ParticleLattice<D> lattice{Vector<D>::Constant(0.3), 0.1, 3};
  const Solid<D> box(Box<D>{Vector<D>::Constant(0.5), Vector<D>::Constant(0.9)});

  const auto sites = fill_cut(box, lattice, cells<D>(8));

  std::vector<Vector<D>> places;
  for (const Site<D>& site : sites) {
    places.push_back(site.place);
    CHECK(site.volume == lattice.particle_volume());
  }
  CHECK(places == fill(box, lattice, cells<D>(8)));
}

TEMPLATE_TEST_CASE_SIG("cut particles of a ball weigh what it does, and their centre is its own", "", ((int D), D), 2,
                       3)
{
  const double radius = GENERATE(1.7, 3.05);
  Vector<D> centre = Vector<D>::Constant(4);
  centre[0] += GENERATE(0.0, 0.21);
  centre[1] += 0.37;
  const ParticleLattice<D> lattice = unit_lattice<D>(GENERATE(1, 2));
  const Solid<D> ball(Ball<D>{centre, radius});

  const auto sites = fill_cut(ball, lattice, cells<D>(8));

  const Site<D> all = whole(sites);
  CHECK(all.volume == Approx(ball.volume().value).epsilon(1e-13));
  CHECK((all.place - centre).norm() < 1e-3 * radius);
  const double share = lattice.particle_volume();
  for (const Site<D>& site : sites) {
    // The scale that makes the whole exact is within 1 %.
    CHECK(site.volume > 0.495 * share);
    CHECK(site.volume < 2.5 * share);
    CHECK(ball.contains(site.place));
  }
}

TEST_CASE("a cut body between two lattice planes is its own image")
{
  const Solid<2> ball(Ball<2>{{4, 4.3}, 2.6});

  auto sites = fill_cut(ball, unit_lattice<2>(2), cells<2>(8));

  for (const Site<2>& site : sites) {
    const Vector<2> image(8 - site.place[0], site.place[1]);
    CHECK(std::any_of(sites.begin(), sites.end(), [&](const Site<2>& other) {
      return (other.place - image).norm() < 1e-12 && std::abs(other.volume - site.volume) < 1e-12;
    }));
  }
}

TEST_CASE("a hole takes its volume from a plate, and a box at any place keeps its own")
{
  const Solid<2> plate(Difference<2>{Solid<2>(Box<2>{{0, 0}, {8, 8}}), {Solid<2>(Ball<2>{{4, 4}, 1.9})}});
  const Solid<2> box(Box<2>{{1.13, 2.31}, {5.77, 2.83}});

  CHECK(whole(fill_cut(plate, unit_lattice<2>(2), cells<2>(8))).volume ==
        Approx(64 - std::numbers::pi * 1.9 * 1.9).epsilon(1e-4));
  const Site<2> all = whole(fill_cut(box, unit_lattice<2>(2), cells<2>(8)));
  CHECK(all.volume == Approx(4.64 * 0.52).epsilon(1e-13));
  CHECK((all.place - Vector<2>(3.45, 2.57)).norm() < 0.01);
}

TEST_CASE("a cut body beyond the cells ends at them")
{
  const Solid<2> ball(Ball<2>{{0, 4}, 3});

  const Site<2> half = whole(fill_cut(ball, unit_lattice<2>(2), cells<2>(8)));

  CHECK(half.volume == Approx(0.5 * std::numbers::pi * 9).epsilon(1e-3));
  CHECK(half.place[0] == Approx(4 / std::numbers::pi).epsilon(1e-3));
}

TEST_CASE("a lattice without sites has no cut particles")
{
  CHECK_THROWS_AS(fill_cut(Solid<2>(Ball<2>{{4, 4}, 3}), ParticleLattice<2>{{0, 0}, 1, 0}, cells<2>(8)), BadValue);
}

}  // namespace test_cut_lattice
