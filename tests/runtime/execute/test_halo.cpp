#include <catch2/catch.hpp>
#include <cmath>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "runtime/execute/halo.hpp"

namespace tamp::runtime::test_halo
{

namespace
{

const NodeLabel<double, "warmth"> warmth;
const NodeLabel<double, "sum"> sum;
const CellLabel<double, "state"> state;

/// Warmth of the step before with a halo, and sums over patches.
std::vector<TaskDeclaration> node_tasks(int halo)
{
  return {task("warm")
              .over_patches_and_groups()
              .reads(warmth.previous().halo(halo))
              .computes(warmth)
              .accumulates(sum.halo(halo))
              .body([](const TaskContext&, auto) {})};
}

/// A number that tells patches and nodes apart; sums of such numbers depend on their order.
double value(int patch, const Index& i)
{
  return 0.1 * patch + std::sqrt(200.0 + i[0] + 10 * i[1] + 100 * i[2]);
}

struct Nodes {
  explicit Nodes(int dimension, int halo_)
      : halo(halo_),
        layout({dimension, {0, 0, 0}, 1, {15, 15, dimension == 3 ? 15 : 1}}, {3, 3, dimension == 3 ? 3 : 1}),
        graph(node_tasks(halo), layout, {"only"}, {{&warmth}, {&sum}}),
        warehouse(std::vector<const TaskGraph*>{&graph})
  {
    for (const Patch& patch : layout) {
      Field& whole = warehouse.field(sum, patch.id, 0);
      const GridView<double> parts(reinterpret_cast<double*>(whole.written_values(FieldBuffer::part)), whole.box,
                                   whole.box.strides());
      for_each(whole.box, [&](const Index& i) { parts[i] = value(patch.id, i); });
      const GridView<double> own = warehouse.grid_state(warmth, patch.id, 0);
      for_each(patch.nodes, [&](const Index& i) { own[i] = value(patch.id, i); });
    }
  }

  int halo;
  PatchLayout layout;
  TaskGraph graph;
  Warehouse warehouse;
};

}  // namespace

TEST_CASE("a halo is filled with what the neighbours have, and the nodes of a seam stay the patch's own")
{
  const int dimension = GENERATE(2, 3), halo = GENERATE(1, 2);
  Nodes nodes(dimension, halo);

  for (const Patch& patch : nodes.layout) {
    fill_halo(bind_halo_fill(nodes.warehouse, warmth, patch.id, 0, halo), FieldBuffer::previous);
  }

  for (const Patch& patch : nodes.layout) {
    const GridView<double> filled = nodes.warehouse.grid_state(warmth, patch.id, 0);
    for_each(grown(patch.nodes, halo, dimension), [&](const Index& i) {
      // Any of the neighbours that have the node may have given it.
      bool known = false, found = false;
      for (const Patch& other : nodes.layout) {
        if (!other.nodes.contains(i) || (patch.nodes.contains(i) && other.id != patch.id)) continue;
        known = true;
        found |= filled[i] == value(other.id, i);
      }
      CHECK(found == known);
    });
  }
}

TEST_CASE("the parts of all patches that reach a node are summed in the order of patches")
{
  const int dimension = GENERATE(2, 3), halo = GENERATE(0, 1);
  Nodes nodes(dimension, halo);

  for (const Patch& patch : nodes.layout) sum_halo(bind_halo_sum(nodes.warehouse, sum, patch.id, 0, halo));

  for (const Patch& patch : nodes.layout) {
    const GridView<const double> sums = nodes.warehouse.grid_result(sum, patch.id, 0);
    for_each(grown(patch.nodes, halo, dimension), [&](const Index& i) {
      double expected = 0;
      for (const Patch& other : nodes.layout) {
        if (grown(other.nodes, halo, dimension).contains(i)) expected += value(other.id, i);
      }
      CHECK(sums[i] == expected);
    });
  }
}

TEST_CASE("state that others read of the step before only comes in every step", "[ranks]")
{
  const Communicator all = Communicator::world();
  PatchLayout layout({2, {0, 0, 0}, 1, {4, 12, 1}}, {1, 6, 1});
  std::vector<int> ranks = layout.ranks();
  for (std::size_t p = 0; p < ranks.size(); ++p) ranks[p] = static_cast<int>(p) % all.size();
  layout.give_to_ranks(ranks, all.size());
  bool as_expected = true;
  auto count = task("count")
                   .over_patches_and_groups()
                   .reads(state.previous().halo(1))
                   .computes(state)
                   .body([&](const TaskContext& at, auto data) {
                     const auto old = data[state.previous()];
                     const auto now = data[state];
                     const IndexBox seen = intersection(grown(at.patch.cells, 1, 2), at.layout.grid().cells());
                     const auto n = static_cast<double>(at.step.index);
                     for_each(seen, [&](const Index& i) { as_expected &= old[i] == n; });
                     for_each(at.patch.cells, [&](const Index& i) { now[i] = n + 1; });
                   });
  const TaskGraph graph({count}, layout, {"only"}, {{&state}, {}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph}, all.rank());
  BoundGraph bound(graph, warehouse, all);
  Schedule schedule(bound, 1);
  Executor executor(1);

  for (long n = 0; n < 5; ++n) {
    executor.run(schedule, {n, 0, 1, 1});
    warehouse.advance();
  }

  CHECK(as_expected);
}

}  // namespace tamp::runtime::test_halo
