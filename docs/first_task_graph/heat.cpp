// The program of docs/first_task_graph.md: the heat equation on the unit square, on threads and ranks.

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <numbers>

#include "runtime/engine.hpp"

using namespace tamp::runtime;

// What a number lives on, its type and its name.
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

// The greatest error at `end` on n x n cells.
double error_of_heat(int n, double end, int n_threads, const Communicator& ranks)
{
  const Grid grid{2, {0, 0, 0}, 1.0 / n, {n, n, 1}};
  PatchLayout layout(grid, {4, 4, 1});
  std::vector<int> rank_of_patch(16);
  for (int p = 0; p < 16; ++p) rank_of_patch[static_cast<std::size_t>(p)] = p * ranks.size() / 16;
  layout.give_to_ranks(rank_of_patch, ranks.size());

  const HostData host{{&temperature}, {&errors}};
  Executor executor(n_threads);
  Engine engine(layout, {"plate"}, {{{diffuse(grid), compare(grid)}, host}}, executor, ranks);
  for (const Patch& patch : engine.layout()) {
    if (!engine.warehouse().is_local(patch)) continue;
    const auto start = engine.warehouse().grid_state(temperature, patch.id, 0);
    for_each(patch.cells, [&](const Index& i) { start[i] = exact(grid, i, 0); });
  }

  const double dt = grid.cell_size * grid.cell_size / 5;
  while (engine.progress().time < end) engine.advance(dt, end);
  return engine.warehouse().result(errors).greatest;
}

int main(int argc, char** argv)
{
  const MpiSession mpi(argc, argv);
  const Communicator ranks = Communicator::world();
  const double coarse = error_of_heat(16, 0.02, 2, ranks), fine = error_of_heat(32, 0.02, 2, ranks);
  if (ranks.is_first()) {
    fmt::print("greatest error on 16 x 16 cells {:.17g}, on 32 x 32 {:.17g}: order {:.3f}\n", coarse, fine,
               std::log2(coarse / fine));
  }
  return std::abs(std::log2(coarse / fine) - 2) < 0.1 ? EXIT_SUCCESS : EXIT_FAILURE;
}
