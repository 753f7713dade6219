#include "runtime/profile/task_rows.hpp"

#include <catch2/catch.hpp>

namespace tamp::runtime::test_task_rows
{

namespace
{

/// A task that took so many ticks on each of six patches.
TaskRow row_with(const std::vector<std::uint64_t>& per_patch)
{
  TaskRow row{.name = "stress", .over_patches = true, .totals = {}, .per_patch = per_patch};
  for (const std::uint64_t ticks : per_patch) {
    if (ticks > 0) row.totals.durations.add(ticks);
  }
  return row;
}

double imbalance(const TaskRow& row, int rank)
{
  const RowScales scales{.all_ticks = 100, .second_per_tick = 1, .rank = rank};
  return statistics({row}, scales, {0, 0, 0, 1, 1, 1}).at(0).imbalance;
}

}  // namespace

TEST_CASE("how uneven a task is on a rank is told by the patches of that rank, idle ones among them", "[profile]")
{
  CHECK(imbalance(row_with({0, 0, 0, 4, 4, 4}), 1) == 1);
  CHECK(imbalance(row_with({0, 0, 0, 6, 6, 0}), 1) == 1.5);
  // The rank worked on patch 0 before that was dealt to another rank.
  CHECK(imbalance(row_with({3, 0, 0, 3, 3, 3}), 1) == 1);
  CHECK(imbalance(row_with({0, 0, 0, 4, 4, 4}), -1) == 2);
}

}  // namespace tamp::runtime::test_task_rows
