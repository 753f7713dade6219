#include <catch2/catch.hpp>

#include "tests/runtime/heat.hpp"

namespace tamp::runtime::test_access
{

namespace
{

const CellLabel<double, "field"> field;
const CellLabel<double, "copy"> copy;

/// Runs one step in which a task that declared `halo` layers reads `reach` layers to its left.
void read_beyond(int halo, int reach)
{
  auto make = task("make").over_patches_and_groups().computes(field).body([](const TaskContext& at, auto data) {
    const auto f = data[field];
    for_each(at.patch.cells, [&](const Index& i) { f[i] = 1; });
  });
  auto use = task("use")
                 .over_patches_and_groups()
                 .reads(field.halo(halo))
                 .computes(copy)
                 .body([reach](const TaskContext& at, auto data) {
                   const auto f = data[field];
                   const auto c = data[copy];
                   for_each(at.patch.cells, [&](const Index& i) {
                     if (i[0] >= reach) c[i] = f[{i[0] - reach, i[1], i[2]}];
                   });
                 });
  const PatchLayout layout({2, {0, 0, 0}, 1, {8, 8, 1}}, {2, 1, 1});
  const TaskGraph graph({make, use}, layout, {"only"}, {{}, {&copy}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph});
  BoundGraph bound(graph, warehouse);
  Schedule schedule(bound, 1);
  Executor(1).run(schedule, {});
}

}  // namespace

TEST_CASE("the checked build catches a read beyond the declared halo", "[access]")
{
  CHECK_NOTHROW(read_beyond(1, 1));
  if constexpr (checked_build) {
    CHECK_THROWS_WITH(read_beyond(1, 2),
                      Catch::Contains("task 'use' on patch 1") && Catch::Contains("outside of the declared halo"));
  }
}

TEST_CASE("the checked build fills what is to be computed with not-a-number", "[access]")
{
  auto lazy = task("lazy").over_patches_and_groups().computes(field).body([](const TaskContext&, auto) {});
  const PatchLayout layout({2, {0, 0, 0}, 1, {4, 4, 1}}, {1, 1, 1});
  const TaskGraph graph({lazy}, layout, {"only"}, {{}, {&field}});
  Warehouse warehouse(std::vector<const TaskGraph*>{&graph});
  BoundGraph bound(graph, warehouse);
  Schedule schedule(bound, 1);

  Executor(1).run(schedule, {});

  CHECK(std::isnan(warehouse.grid_result(field, 0, 0)[{0, 0, 0}]) == checked_build);
}

}  // namespace tamp::runtime::test_access
