#include <array>
#include <stdexcept>
#include <utility>

#include "runtime/engine.hpp"
#include "tools/bench/tasks_schedulers.hpp"

namespace tamp::tools::bench
{

namespace
{

using namespace runtime;

constexpr int most_rows = 10;

constexpr LabelName<6> name_of_row(int row)
{
  const char letters[6] = {'r', 'o', 'w', ' ', static_cast<char>('0' + row), '\0'};
  return letters;
}

/// The label that the tasks of a row of the pattern make: a number on each patch, which has one cell.
template <int Row>
const CellLabel<std::uint64_t, name_of_row(Row)> made_in{};

/// A task of the pattern, which also hands a number on from row to row.
template <int Row>
TaskDeclaration declare_row(StampedTasks& tasks)
{
  constexpr int row_before = (Row + most_rows - 1) % most_rows;
  return task(made_in<Row>.name())
      .over_patches_and_groups()
      .reads(made_in<row_before>.halo(1).when(Row > 0))
      .computes(made_in<Row>)
      .body([&tasks](const TaskContext& at, auto data) {
        const Index& cell = at.patch.cells.lower;
        const auto before = data[made_in<row_before>];
        data[made_in<Row>][cell] = before.empty() ? 0 : before[cell] + 1;
        const Index& n = at.layout.n_patches();
        tasks.run(tasks.row(Row) + (cell[2] * n[1] + cell[1]) * n[0] + cell[0]);
      });
}

template <int... Rows>
GraphTasks declare_all(StampedTasks& tasks, std::integer_sequence<int, Rows...> /*rows*/)
{
  if (tasks.n_steps() > most_rows) throw std::invalid_argument("more rows than there are labels for");
  const std::array<const Label*, most_rows> labels{&made_in<Rows>...};
  TaskList declared{declare_row<Rows>(tasks)...};
  const auto n_rows = static_cast<std::size_t>(tasks.n_steps());
  declared.resize(n_rows);
  return {std::move(declared), {{}, {labels[n_rows - 1]}}};
}

/// A patch of one cell for each point, which with a halo of one layer reads what the pattern says.
PatchLayout layout_of(const PatternShape& shape)
{
  const std::array<bool, 3> periodic{shape.is_periodic, shape.is_periodic, shape.is_periodic};
  return {{3, {0, 0, 0}, 1, shape.n_points, periodic}, shape.n_points};
}

class DeclaredTasks : public TaskScheduler
{
 public:
  DeclaredTasks(StampedTasks& tasks, int n_threads)
      : tasks_(tasks),
        executor_(n_threads),
        engine_(layout_of(tasks.shape().value()), {"all"},
                {declare_all(tasks, std::make_integer_sequence<int, most_rows>())}, executor_)
  {
  }

  void run(int n_runs) override
  {
    for (int i = 0; i < n_runs; ++i) {
      tasks_.begin_run();
      engine_.advance(1);
    }
  }

 private:
  StampedTasks& tasks_;
  Executor executor_;
  Engine engine_;
};

}  // namespace

TaskContestant declared_contestant()
{
  TaskContestant declared{"tamp, declared", [](StampedTasks& tasks, int n_threads) -> std::unique_ptr<TaskScheduler> {
                            return std::make_unique<DeclaredTasks>(tasks, n_threads);
                          }};
  declared.reads_neighbours_only = true;
  return declared;
}

}  // namespace tamp::tools::bench
