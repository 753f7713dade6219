#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/engine.hpp"
#include "runtime/execute/halo.hpp"
#include "tests/runtime/shared_cores.hpp"

/// Grids whose ends along some axes are one place.
namespace tamp::runtime::test_periodic
{

namespace
{

const CellLabel<double, "heat of cells"> heat;
const NodeLabel<double, "sum of nodes"> node_sum;

Grid periodic_grid(int dimension, const Index& n_cells, const std::array<bool, 3>& periodic)
{
  Grid grid{dimension, {0, 0, 0}, 1, n_cells};
  grid.periodic = periodic;
  return grid;
}

/// An index along periodic axes brought to where it is from 0 to n_cells - 1.
Index brought_home(const Grid& grid, Index i)
{
  for (std::size_t k = 0; k < 3; ++k) {
    const int n = grid.n_cells[k];
    if (grid.periodic[k]) i[k] = (i[k] % n + n) % n;
  }
  return i;
}

std::vector<TaskDeclaration> adding(int halo)
{
  return {task("add").over_patches_and_groups().accumulates(node_sum.halo(halo)).body([](const TaskContext&, auto) {})};
}

/// Numbers whose sum differs if they are added in another order.
double part_of(int patch, const Index& i)
{
  return 0.1 * patch + std::sqrt(200.0 + i[0] + 10 * i[1] + 100 * i[2]);
}

}  // namespace

TEST_CASE("every node of a periodic grid is owned once and shown at both ends", "[periodic]")
{
  const auto n_patches = GENERATE(Index{1, 1, 1}, Index{2, 1, 1}, Index{3, 2, 1});
  const PatchLayout layout(periodic_grid(2, {12, 6, 1}, {true, false, false}), n_patches);

  std::vector<int> owners(13 * 7, 0), shows(13 * 7, 0);
  for (const Patch& patch : layout) {
    for_each(layout.owned_nodes(patch), [&](const Index& i) { ++owners[static_cast<std::size_t>(i[0] + 13 * i[1])]; });
    for_each(layout.shown_nodes(patch), [&](const Index& i) { ++shows[static_cast<std::size_t>(i[0] + 13 * i[1])]; });
  }

  for (int j = 0; j < 7; ++j) {
    for (int i = 0; i < 13; ++i) {
      CHECK(owners[static_cast<std::size_t>(i + 13 * j)] == (i < 12 ? 1 : 0));
      CHECK(shows[static_cast<std::size_t>(i + 13 * j)] == 1);
    }
  }
}

TEST_CASE("a patch of a periodic grid has itself and others as neighbours beyond the ends", "[periodic]")
{
  const auto images_of = [](int n_patches) {
    const PatchLayout layout(periodic_grid(2, {12, 6, 1}, {true, false, false}), {n_patches, 1, 1});
    std::vector<std::pair<int, int>> images;
    for (const PatchImage& image : layout[0].images) images.emplace_back(image.patch, image.shift[0]);
    return images;
  };
  using Images = std::vector<std::pair<int, int>>;

  CHECK(images_of(1) == Images{{0, 12}, {0, 0}, {0, -12}});
  CHECK(images_of(2) == Images{{0, 0}, {1, 0}, {1, -12}});
  CHECK(images_of(4) == Images{{0, 0}, {1, 0}, {3, -12}});
}

TEST_CASE("parts that reach a node from both ends are summed in one order wherever the node is seen", "[periodic]")
{
  const int dimension = GENERATE(2, 3), halo = GENERATE(0, 1);
  const int n = GENERATE(1, 2, 3);
  const auto periodic = GENERATE(std::array{true, false, false}, std::array{false, true, false},
                                 std::array{true, true, false}, std::array{true, true, true});
  if (dimension == 2 && periodic[2]) return;
  const bool deep = dimension == 3;
  const PatchLayout layout(periodic_grid(dimension, {6 * n, 5, deep ? 4 : 1}, periodic), {n, 1, 1});
  const TaskGraph graph(adding(halo), layout, {"only"}, {{}, {&node_sum}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph});
  for (const Patch& patch : layout) {
    Field& field = warehouse.field(node_sum, patch.id, 0);
    const GridView<double> parts(reinterpret_cast<double*>(field.written_values(FieldBuffer::part)), field.box,
                                 field.box.strides());
    for_each(field.box, [&](const Index& i) { parts[i] = part_of(patch.id, i); });
  }

  for (const Patch& patch : layout) sum_halo(bind_halo_sum(warehouse, node_sum, patch.id, 0, halo));

  bool as_expected = true;
  for (const Patch& patch : layout) {
    const GridView<const double> sums = warehouse.grid_result(node_sum, patch.id, 0);
    for_each(grown(patch.nodes, halo, dimension), [&](const Index& i) {
      double expected = 0;
      for (const Patch& other : layout) {
        for_each(grown(other.nodes, halo, dimension), [&](const Index& j) {
          if (brought_home(layout.grid(), j) == brought_home(layout.grid(), i)) expected += part_of(other.id, j);
        });
      }
      as_expected &= sums[i] == expected;
    });
  }
  CHECK(as_expected);
}

TEST_CASE("a halo that does not fit between the ends of a periodic axis is refused", "[periodic]")
{
  const PatchLayout narrow(periodic_grid(2, {2, 6, 1}, {true, false, false}), {1, 1, 1});
  const PatchLayout wide(periodic_grid(2, {3, 6, 1}, {true, false, false}), {1, 1, 1});

  CHECK_THROWS_WITH(TaskGraph(adding(1), narrow, {"only"}, {{}, {&node_sum}}),
                    Catch::Contains("at least 3 cells wide"));
  CHECK_NOTHROW(TaskGraph(adding(1), wide, {"only"}, {{}, {&node_sum}}));
}

namespace
{

/// Heat on a grid that is periodic along x and insulated along y, so that cos(2 pi w x) cos(pi y) keeps its shape; and,
/// on the nodes, the sum of what the cells around each give, in parts of patches.
struct RingOfHeat {
  static constexpr int n_waves = 2;

  RingOfHeat(const Index& n_patches, int n_threads, const Communicator& all = {})
      : executor(n_threads, test::on_shared_cores()),
        engine(dealt(n_patches, all), {"only"}, {{{give(), diffuse()}, {{&heat}, {&node_sum}}}}, executor, all),
        communicator(all)
  {
    for (const Patch& patch : engine.layout()) {
      if (!engine.warehouse().is_local(patch)) continue;
      const auto start = engine.warehouse().grid_state(heat, patch.id, 0);
      for_each(patch.cells, [&](const Index& i) { start[i] = shape(i); });
    }
  }

  static Index n_cells() { return {18, 9, 1}; }

  static PatchLayout dealt(const Index& n_patches, const Communicator& all)
  {
    PatchLayout layout(periodic_grid(2, n_cells(), {true, false, false}), n_patches);
    std::vector<int> ranks = layout.ranks();
    for (std::size_t p = 0; p < ranks.size(); ++p) ranks[p] = static_cast<int>(p) % all.size();
    layout.give_to_ranks(ranks, all.size());
    return layout;
  }

  /// Out of step with the cut of the grid.
  static double shape(const Index& i)
  {
    constexpr double pi = std::numbers::pi;
    return std::cos(2 * pi * n_waves * (i[0] + 0.3) / n_cells()[0]) * std::cos(pi * (i[1] + 0.5) / n_cells()[1]);
  }

  /// The part of the shape that a step leaves.
  static double decay(double dt)
  {
    constexpr double pi = std::numbers::pi;
    const double along = std::sin(pi * n_waves / n_cells()[0]), across = std::sin(0.5 * pi / n_cells()[1]);
    return 1 - 4 * dt * (along * along + across * across);
  }

  static TaskDeclaration give()
  {
    return task("give")
        .over_patches_and_groups()
        .reads(heat.previous())
        .accumulates(node_sum.halo(1))
        .body([](const TaskContext& at, auto data) {
          const auto old = data[heat.previous()];
          const auto sum = data[node_sum];
          for_each(at.patch.cells, [&](const Index& i) {
            for_each(IndexBox{{i[0] - 1, i[1] - 1, 0}, {i[0] + 3, i[1] + 3, 1}},
                     [&](const Index& node) { sum[node] += old[i] / 16; });
          });
        });
  }

  static TaskDeclaration diffuse()
  {
    return task("diffuse")
        .over_patches_and_groups()
        .reads(heat.previous().halo(1))
        .computes(heat)
        .body([](const TaskContext& at, auto data) {
          const auto old = data[heat.previous()];
          const auto now = data[heat];
          for_each(at.patch.cells, [&](const Index& i) {
            double flow = old[{i[0] - 1, i[1], 0}] + old[{i[0] + 1, i[1], 0}] - 2 * old[i];
            if (i[1] > 0) flow += old[{i[0], i[1] - 1, 0}] - old[i];
            if (i[1] < n_cells()[1] - 1) flow += old[{i[0], i[1] + 1, 0}] - old[i];
            now[i] = old[i] + at.step.size * flow;
          });
        });
  }

  void run(long n_steps, double dt)
  {
    for (long n = 0; n < n_steps; ++n) engine.advance(dt);
  }

  /// The value of every index in the boxes of the patches, x fastest over all, alike on all ranks.
  template <class Boxes, class Values>
  std::vector<double> over_all(const Index& n, const Boxes& box_of, const Values& values_of)
  {
    std::vector<double> own(static_cast<std::size_t>(n[0] * n[1]), 0.0);
    for (const Patch& patch : engine.layout()) {
      if (!engine.warehouse().is_local(patch)) continue;
      const auto values = values_of(patch.id);
      for_each(box_of(patch), [&](const Index& i) { own[static_cast<std::size_t>(i[0] + n[0] * i[1])] = values[i]; });
    }
    std::vector<double> all(own.size(), 0.0);
    for (const auto& bytes : communicator.gather(std::as_bytes(std::span(own)))) {
      const auto* theirs = reinterpret_cast<const double*>(bytes.data());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += theirs[i];
    }
    return all;
  }
  std::vector<double> temperatures()
  {
    return over_all(
        n_cells(), [](const Patch& patch) { return patch.cells; },
        [&](int patch) { return engine.warehouse().grid_state(heat, patch, 0); });
  }
  std::vector<double> sums()
  {
    return over_all(
        {n_cells()[0] + 1, n_cells()[1] + 1, 1}, [&](const Patch& patch) { return engine.layout().shown_nodes(patch); },
        [&](int patch) { return engine.warehouse().grid_result(node_sum, patch, 0); });
  }

  Executor executor;
  Engine engine;
  Communicator communicator;
};

}  // namespace

TEST_CASE("waves of heat around a periodic grid decay as the difference equation has it", "[periodic][ranks]")
{
  const auto n_patches = GENERATE(Index{1, 1, 1}, Index{2, 1, 1}, Index{3, 3, 1}, Index{6, 1, 1});
  RingOfHeat ring(n_patches, 2, Communicator::world());

  ring.run(40, 0.2);

  const std::vector<double> now = ring.temperatures();
  double worst = 0;
  std::size_t k = 0;
  for_each(IndexBox{{0, 0, 0}, RingOfHeat::n_cells()}, [&](const Index& i) {
    worst = std::max(worst, std::abs(now[k++] - RingOfHeat::shape(i) * std::pow(RingOfHeat::decay(0.2), 40)));
  });
  CHECK(worst < 1e-13);
  RingOfHeat alone({1, 1, 1}, 1);
  alone.run(40, 0.2);
  CHECK(now == alone.temperatures());
}

TEST_CASE("sums on the nodes of a periodic grid are the same on any ranks and threads", "[periodic][ranks]")
{
  const auto n_patches = GENERATE(Index{1, 1, 1}, Index{2, 1, 1}, Index{2, 3, 1}, Index{6, 1, 1});
  const int n_threads = GENERATE(1, 3);
  RingOfHeat ring(n_patches, n_threads, Communicator::world());
  RingOfHeat alone(n_patches, 1);

  ring.run(3, 0.2);
  alone.run(3, 0.2);

  const std::vector<double> sums = ring.sums();
  CHECK(sums == alone.sums());
  // The two ends are one, and hold what is around both.
  const auto n = static_cast<std::size_t>(RingOfHeat::n_cells()[0]);
  const double faded = std::pow(RingOfHeat::decay(0.2), 2) / 16;
  for (int j = 2; j < 8; ++j) {
    const auto row = static_cast<std::size_t>(j) * (n + 1);
    CHECK(sums[row] == sums[row + n]);
    double expected = 0;
    for_each(IndexBox{{-2, j - 2, 0}, {2, j + 2, 1}},
             [&](const Index& i) { expected += RingOfHeat::shape(i) * faded; });
    CHECK(sums[row] == Approx(expected).margin(1e-14));
  }
}

namespace
{

using Point = std::array<double, 2>;

const ParticleLabel<Point, "place"> place;
const ParticleLabel<std::int64_t, "number"> number;
const ParticleLabel<Index, "laps"> laps;

struct Traveller {
  Point place;
  std::int64_t number;
  Index laps;
};

/// Particles that drift by (dx, dy) a step through 9 x 6 cells, periodic along x, from a grid's corner at (1, 2).
struct Carousel {
  Carousel(const Index& n_patches, double dx, double dy, const Communicator& all = {}, int n_threads = 2)
      : executor(n_threads, test::on_shared_cores()),
        engine(dealt(n_patches, all), {"only"},
               {{{drift(dx, dy), migration(place, &laps)}, {{&place, &number, &laps}, {}}}}, executor, all),
        communicator(all)
  {
    for (const Patch& patch : engine.layout()) {
      if (!engine.warehouse().is_local(patch)) continue;
      engine.warehouse().set_n_particles(patch.id, 0, static_cast<std::size_t>(patch.cells.size()));
      std::size_t p = 0;
      for_each(patch.cells, [&](const Index& i) {
        engine.warehouse().state(place, patch.id, 0)[p] = {1.3 + i[0], 2.6 + i[1]};
        engine.warehouse().state(number, patch.id, 0)[p++] = i[0] + 9 * i[1];
      });
    }
  }

  static PatchLayout dealt(const Index& n_patches, const Communicator& all)
  {
    Grid grid{2, {1, 2, 0}, 1, {9, 6, 1}};
    grid.periodic[0] = true;
    PatchLayout layout(grid, n_patches);
    std::vector<int> ranks = layout.ranks();
    for (std::size_t p = 0; p < ranks.size(); ++p) ranks[p] = static_cast<int>(p) % all.size();
    layout.give_to_ranks(ranks, all.size());
    return layout;
  }

  static TaskDeclaration drift(double dx, double dy)
  {
    return task("drift")
        .over_patches_and_groups()
        .reads(place.previous())
        .computes(place)
        .body([dx, dy](const TaskContext&, auto data) {
          const auto old = data[place.previous()];
          const auto now = data[place];
          for (std::size_t p = 0; p < old.size(); ++p) now[p] = {old[p][0] + dx, old[p][1] + dy};
        });
  }

  void run(int n_steps)
  {
    for (int n = 0; n < n_steps; ++n) engine.advance(1);
  }

  /// By number; what is not in the cells of its patch is left out.
  std::vector<Traveller> travellers()
  {
    std::vector<Traveller> own;
    for (const Patch& patch : engine.layout()) {
      const auto x = engine.warehouse().state(place, patch.id, 0);
      for (std::size_t p = 0; p < x.size(); ++p) {
        const Index cell{static_cast<int>(std::floor(x[p][0] - 1)), static_cast<int>(std::floor(x[p][1] - 2)), 0};
        if (!patch.cells.contains(cell)) continue;
        own.push_back(
            {x[p], engine.warehouse().state(number, patch.id, 0)[p], engine.warehouse().state(laps, patch.id, 0)[p]});
      }
    }
    std::vector<Traveller> all;
    for (const auto& bytes : communicator.gather(std::as_bytes(std::span(own)))) {
      const auto* theirs = reinterpret_cast<const Traveller*>(bytes.data());
      all.insert(all.end(), theirs, theirs + bytes.size() / sizeof(Traveller));
    }
    std::sort(all.begin(), all.end(), [](const Traveller& a, const Traveller& b) { return a.number < b.number; });
    return all;
  }

  Executor executor;
  Engine engine;
  Communicator communicator;
};

}  // namespace

TEST_CASE("particles that leave a periodic grid enter at the other end, and their laps are counted",
          "[periodic][ranks]")
{
  const auto n_patches = GENERATE(Index{1, 1, 1}, Index{1, 2, 1}, Index{3, 1, 1}, Index{3, 2, 1});
  const double dx = GENERATE(0.75, -0.75);
  Carousel carousel(n_patches, dx, 0, Communicator::world());

  carousel.run(30);

  const std::vector<Traveller> all = carousel.travellers();
  REQUIRE(all.size() == 54);
  for (std::size_t p = 0; p < all.size(); ++p) {
    CHECK(all[p].number == static_cast<std::int64_t>(p));
    CHECK((all[p].laps[1] == 0 && all[p].laps[2] == 0));
    CHECK(all[p].place[0] + 9 * all[p].laps[0] == Approx(1.3 + static_cast<double>(p % 9) + 30 * dx).epsilon(1e-13));
  }
}

TEST_CASE("where a particle comes to in a periodic grid does not depend on the cut, to the last bit",
          "[periodic][ranks]")
{
  const auto n_patches = GENERATE(Index{1, 2, 1}, Index{3, 1, 1}, Index{3, 2, 1});
  Carousel cut(n_patches, 0.7, 0, Communicator::world()), whole({1, 1, 1}, 0.7, 0);

  cut.run(50);
  whole.run(50);

  const auto there = cut.travellers(), expected = whole.travellers();
  REQUIRE(there.size() == expected.size());
  for (std::size_t p = 0; p < there.size(); ++p) {
    CHECK(there[p].place == expected[p].place);
    CHECK(there[p].laps == expected[p].laps);
  }
}

TEST_CASE("a particle beyond an end of a periodic grid by round-off alone is at its lower end", "[periodic]")
{
  Carousel carousel({1, 1, 1}, 0, 0);
  const double below = std::nextafter(1.0, 0.0);
  REQUIRE(below + 9 == 10.0);
  carousel.engine.warehouse().state(place, 0, 0)[0][0] = below;
  carousel.engine.warehouse().state(place, 0, 0)[1][0] = 10.0;

  carousel.run(1);

  const std::vector<Traveller> all = carousel.travellers();
  REQUIRE(all.size() == 54);
  CHECK(all[0].place[0] == 1.0);
  CHECK(all[0].laps[0] == 0);
  CHECK(all[1].place[0] == 1.0);
  CHECK(all[1].laps[0] == 1);
}

TEST_CASE("a periodic grid loses what leaves it along another axis and what is not a number", "[periodic]")
{
  const double dx = GENERATE(0.0, std::numeric_limits<double>::quiet_NaN());
  Carousel carousel({3, 2, 1}, dx, 1);

  carousel.run(1);

  CHECK(carousel.engine.warehouse().n_particles(0) == (dx == 0 ? 45U : 0U));
}

}  // namespace tamp::runtime::test_periodic
