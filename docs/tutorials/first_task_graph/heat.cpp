// The program of docs/tutorials/first_task_graph.md: the heat equation on the unit square, on threads and ranks.

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <exception>
#include <filesystem>
#include <numbers>
#include <string>
#include <tuple>
#include <vector>

#include "runtime/engine.hpp"
#include "runtime/file_error.hpp"
#include "runtime/profile/report.hpp"
#include "runtime/profile/table.hpp"

using namespace tamp::runtime;

// Labels: where a number lives, its type and its name.
const CellLabel<double, "temperature"> temperature;

// A value of which every patch has a part.
struct Errors {
  double greatest = 0;

  static constexpr auto fields = std::tuple{Greatest{&Errors::greatest}};
};
const ReductionLabel<Errors, "errors"> errors;

double exact(const Grid& grid, const Index& i, double time)
{
  constexpr double pi = std::numbers::pi;
  const double x = (i[0] + 0.5) * grid.cell_size, y = (i[1] + 0.5) * grid.cell_size;
  return std::cos(pi * x) * std::cos(pi * y) * std::exp(-2 * pi * pi * time);
}

// Each cell takes what flows in from its neighbours; nothing flows through the edges of the square.
TaskDeclaration diffuse(const Grid& grid)
{
  return task("diffuse")
      .over_patches_and_groups()
      .reads(temperature.previous().halo(1))
      .computes(temperature)
      .body([grid](const TaskContext& at, auto data) {
        const auto old = data[temperature.previous()];
        const auto now = data[temperature];
        const double factor = at.step.size / (grid.cell_size * grid.cell_size);
        for_each(at.patch.cells, [&](const Index& i) {
          now[i] = old[i];
          for (const Index& next : {Index{i[0] - 1, i[1], 0}, Index{i[0] + 1, i[1], 0}, Index{i[0], i[1] - 1, 0},
                                    Index{i[0], i[1] + 1, 0}}) {
            if (grid.cells().contains(next)) now[i] += factor * (old[next] - old[i]);
          }
        });
      });
}

TaskDeclaration compare(const Grid& grid)
{
  return task("compare")
      .over_patches_and_groups()
      .reads(temperature)
      .reduces(errors)
      .body([grid](const TaskContext& at, auto data) {
        const auto now = data[temperature];
        double& greatest = data[errors].greatest;
        for_each(at.patch.cells, [&](const Index& i) {
          const double error = std::abs(now[i] - exact(grid, i, at.step.time + at.step.size));
          greatest = std::max(greatest, error);
        });
      });
}

// A plate of n x n cells in time, on 16 patches. To begin with the first rank has them all.
struct Plate {
  Plate(int n, Executor& executor, const Communicator& ranks)
      : grid{2, {0, 0, 0}, 1.0 / n, {n, n, 1}}, engine(make_engine(grid, executor, ranks))
  {
    for (const Patch& patch : engine.layout()) {
      if (!engine.warehouse().is_local(patch)) continue;
      const auto start = engine.warehouse().grid_state(temperature, patch.id, 0);
      for_each(patch.cells, [&](const Index& i) { start[i] = exact(grid, i, 0); });
    }
    engine.balance_every(10);
  }

  static Engine make_engine(const Grid& grid, Executor& executor, const Communicator& ranks)
  {
    PatchLayout layout(grid, {4, 4, 1});
    layout.give_to_ranks(std::vector<int>(16, 0), ranks.size());
    const HostData host{{&temperature, &errors}, {}};
    return Engine(layout, {"plate"}, {{{diffuse(grid), compare(grid)}, host}}, executor, ranks);
  }

  void run_to(double end)
  {
    const double dt = grid.cell_size * grid.cell_size / 5;
    while (engine.progress().time < end) engine.advance(dt, end);
  }

  // In the last step, and in all steps so far.
  double error() { return engine.warehouse().result(errors).greatest; }
  double greatest_error() { return engine.warehouse().total(errors).greatest; }

  Grid grid;
  Engine engine;
};

// The greatest error of a plate that goes on from what the folder keeps.
double error_of_restarted(int n, double end, const std::filesystem::path& folder, Executor& executor,
                          const Communicator& ranks)
{
  Plate plate(n, executor, ranks);
  std::vector<std::string> refused;
  const auto newest = newest_checkpoint(folder, refused, ranks);
  if (!newest) throw FileError(folder.string(), fmt::format("no checkpoint is whole: {}", fmt::join(refused, "; ")));
  plate.engine.restart(*newest);
  plate.run_to(end);
  return plate.greatest_error();
}

// Whether the errors fall as they should, and are the same after a restart.
bool solves(const std::filesystem::path& folder, const Communicator& ranks)
{
  Executor executor(2);
  const double middle = 0.01, end = 0.02;
  Plate coarse(16, executor, ranks), fine(32, executor, ranks);
  coarse.run_to(end);
  fine.run_to(middle);
  fine.engine.write_checkpoint(folder, "plate of 32 x 32 cells", {}, 1);
  fine.run_to(end);
  const double restarted = error_of_restarted(32, end, folder, executor, ranks);

  const double order = std::log2(coarse.error() / fine.error());
  const std::string profile = to_text(to_json(fine.engine.profile(), fine.engine.warehouse().ledger(), ranks));
  if (ranks.is_first()) {
    fmt::print("error at the end on 16 x 16 cells {:.17g}, on 32 x 32 {:.17g}: order {:.3f}\n", coarse.error(),
               fine.error(), order);
    fmt::print("greatest error until then {:.17g}, restarted {:.17g}\n", fine.greatest_error(), restarted);
    for (const Rebalance& deal : fine.engine.rebalances()) {
      fmt::print(stderr, "patches dealt anew before step {}\n", deal.step);
    }
    fmt::print(stderr, "{}", profile);
  }
  return std::abs(order - 2) < 0.1 && restarted == fine.greatest_error();
}

int main(int argc, char** argv)
{
  const MpiSession mpi(argc, argv);
  try {
    return solves(argc > 1 ? argv[1] : "heat", Communicator::world()) ? EXIT_SUCCESS : EXIT_FAILURE;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return EXIT_FAILURE;
  }
}
