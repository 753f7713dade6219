#include <vector>

#include "runtime/execute/bound_graph.hpp"
#include "runtime/execute/executor.hpp"
#include "tools/bench/tasks_ranks_contestants.hpp"
#include "tools/system/usable_cores.hpp"

namespace tamp::tools::bench
{

namespace
{

using namespace runtime;

const CellLabel<std::uint64_t, "stamps"> stamps;

/// A layout with one row of cells for each patch, so that a halo of one layer holds a whole neighbour.
PatchLayout layout_of(const PatchRow& shape)
{
  const int n = shape.n_patches();
  PatchLayout layout({2, {0, 0, 0}, 1, {shape.n_values, n, 1}}, {1, n, 1});
  std::vector<int> ranks = layout.ranks();
  for (int patch = 0; patch < n; ++patch) ranks[static_cast<std::size_t>(patch)] = patch / shape.patches_per_rank;
  layout.give_to_ranks(ranks, shape.n_ranks);
  return layout;
}

TaskDeclaration stamp_task(StampedRow& row)
{
  return task("stamp")
      .over_patches_and_groups()
      .reads(stamps.previous().halo(1))
      .computes(stamps)
      .body([&row](const TaskContext& at, auto data) {
        const auto old = data[stamps.previous()];
        const auto now = data[stamps];
        const auto n = static_cast<std::size_t>(row.shape().n_values);
        const int p = at.patch.id;
        const auto values = [&](int patch) { return StampedRow::Values(&old[{0, patch, 0}], n); };
        row.run(at.step.index, p, values(p - 1), values(p), values(p + 1), {&now[{0, p, 0}], n});
      });
}

ExecutorOptions options_on(const Communicator& ranks)
{
  const UsableCores cores = usable_cores(ranks);
  ExecutorOptions options;
  options.oversubscribed = cores.ranks_on_machine > cores.of_machine;
  return options;
}

class HaloGraph : public RowScheduler
{
 public:
  HaloGraph(StampedRow& row, const Communicator& ranks)
      : layout_(layout_of(row.shape())),
        graph_({stamp_task(row)}, layout_, {"only"}, {{&stamps}, {}}),
        warehouse_(std::vector<const TaskGraph*>{&graph_}, ranks.rank()),
        bound_(graph_, warehouse_, ranks),
        schedule_(bound_, 1),
        executor_(1, options_on(ranks))
  {
    for (const Patch& patch : layout_) {
      if (!warehouse_.is_local(patch)) continue;
      const auto values = warehouse_.grid_state(stamps, patch.id, 0);
      for_each(patch.cells, [&](const Index& i) { values[i] = row.stamp(0, patch.id); });
    }
  }

  void run(int n_steps) override
  {
    for (int n = 0; n < n_steps; ++n) {
      executor_.run(schedule_, step_);
      warehouse_.advance();
      ++step_.index;
    }
  }

 private:
  PatchLayout layout_;
  TaskGraph graph_;
  Warehouse warehouse_;
  BoundGraph bound_;
  Schedule schedule_;
  Executor executor_;
  Step step_;
};

}  // namespace

RowContestant tamp_row_contestant()
{
  return {"tamp", [](StampedRow& row, const Communicator& ranks) -> std::unique_ptr<RowScheduler> {
            return std::make_unique<HaloGraph>(row, ranks);
          }};
}

}  // namespace tamp::tools::bench
