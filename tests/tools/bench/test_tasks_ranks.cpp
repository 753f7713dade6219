#include <array>
#include <catch2/catch.hpp>

#include "tools/bench/tasks_ranks_contestants.hpp"

namespace test_tasks_ranks
{

using namespace tamp;
using namespace tamp::tools::bench;

namespace
{

constexpr PatchRow three_patches{1, 3, 2};

/// Fault that the task of patch 1 in step 4 finds in these values.
std::string fault_with(std::array<std::uint64_t, 2> before, std::array<std::uint64_t, 2> own,
                       std::array<std::uint64_t, 2> after)
{
  StampedRow row(three_patches);
  std::array<std::uint64_t, 2> made{};
  row.run(4, 1, before, own, after, made);
  CHECK(made == std::array<std::uint64_t, 2>{row.stamp(5, 1), row.stamp(5, 1)});
  return row.fault();
}

}  // namespace

TEST_CASE("a stale value anywhere in what a task of the row reads is found")
{
  const std::string fault = "the task of step 4, patch 1 read values of another step or patch";

  // Three patches: a step's stamps begin with 1 + 3 x step.
  CHECK(fault_with({13, 13}, {14, 14}, {15, 15}).empty());
  CHECK(fault_with({13, 10}, {14, 14}, {15, 15}) == fault);
  CHECK(fault_with({13, 13}, {11, 14}, {15, 15}) == fault);
  CHECK(fault_with({13, 13}, {14, 14}, {15, 18}) == fault);
  CHECK(fault_with({15, 15}, {14, 14}, {13, 13}) == fault);
}

TEST_CASE("the ends of the row have but one neighbour")
{
  StampedRow row(three_patches);
  std::array<std::uint64_t, 2> first{13, 13}, middle{14, 14}, last{15, 15}, made{};

  row.run(4, 0, {}, first, middle, made);
  row.run(4, 2, middle, last, {}, made);

  CHECK(row.fault().empty());
}

TEST_CASE("the graph and the exchange by hand run every step of the row, on one rank too")
{
  const int patches_per_rank = GENERATE(1, 2, 5);

  for (const RowContestant& contestant : {tamp_row_contestant(), plain_mpi_row_contestant()}) {
    INFO(contestant.name << ", " << patches_per_rank << " patches");
    StampedRow row({1, patches_per_rank, 3});
    const auto scheduler = contestant.make(row, {});
    scheduler->run(1);
    scheduler->run(20);
    CHECK(row.fault().empty());
  }
}

}  // namespace test_tasks_ranks
