#pragma once

#include <cmath>
#include <numbers>
#include <vector>

#include "runtime/engine.hpp"
#include "tests/runtime/shared_cores.hpp"

/// A heat equation on cells, periodic in nothing and with insulated ends: a user of the runtime that has no mechanics
/// in it. dT/dt = a lap T on the unit square, T = cos(pi x) cos(pi y) exp(-2 pi^2 a t).
namespace tamp::test
{

using namespace tamp::runtime;

inline const CellLabel<double, "temperature"> temperature;

struct Heat {
  static inline const ReductionLabel<double, "total heat"> total;

  /// To begin with the first rank has all patches.
  Heat(int n_cells, Index n_patches, int n_threads, const Communicator& ranks = {})
      : grid{2, {0, 0, 0}, 1.0 / n_cells, {n_cells, n_cells, 1}},
        executor(n_threads, on_shared_cores()),
        engine(of_first(PatchLayout(grid, n_patches), ranks), {"heat"},
               {{{diffusion(grid)}, {{&temperature, &total}, {}}}}, executor, ranks)
  {
    for (const Patch& patch : engine.layout()) {
      if (!engine.warehouse().is_local(patch)) continue;
      const auto view = engine.warehouse().grid_state(temperature, patch.id, 0);
      for_each(patch.cells, [&](const Index& i) { view[i] = exact(i, 0); });
    }
  }

  static PatchLayout of_first(PatchLayout layout, const Communicator& ranks)
  {
    layout.give_to_ranks(std::vector<int>(static_cast<std::size_t>(layout.size()), 0), ranks.size());
    return layout;
  }

  double exact(const Index& i, double time) const
  {
    constexpr double pi = std::numbers::pi;
    const double x = (i[0] + 0.5) * grid.cell_size;
    const double y = (i[1] + 0.5) * grid.cell_size;
    return std::cos(pi * x) * std::cos(pi * y) * std::exp(-2 * pi * pi * time);
  }

  static TaskDeclaration diffusion(const Grid& grid)
  {
    return task("diffuse")
        .over_patches_and_groups()
        .reads(temperature.previous().halo(1))
        .computes(temperature)
        .reduces(total)
        .body([grid](const TaskContext& at, auto data) {
          const auto old = data[temperature.previous()];
          const auto now = data[temperature];
          double& sum = data[total];
          const double factor = at.step.size / (grid.cell_size * grid.cell_size);
          for_each(at.patch.cells, [&](const Index& i) {
            const auto flux = [&](int axis, int side) {
              Index next = i;
              next[static_cast<std::size_t>(axis)] += side;
              return grid.cells().contains(next) ? old[next] - old[i] : 0.0;
            };
            now[i] = old[i] + factor * (flux(0, -1) + flux(0, 1) + flux(1, -1) + flux(1, 1));
            sum += now[i];
          });
        });
  }

  void run(long n_steps, double dt)
  {
    for (long n = 0; n < n_steps; ++n) engine.advance(dt);
  }

  /// Values of all ranks.
  std::vector<double> values()
  {
    std::vector<double> own, all;
    for_each(grid.cells(), [&](const Index& i) {
      const Patch& patch = engine.layout()[engine.layout().patch_of_cell(i)];
      own.push_back(engine.warehouse().is_local(patch) ? engine.warehouse().grid_state(temperature, patch.id, 0)[i]
                                                       : 0);
    });
    all.resize(own.size());
    for (const auto& bytes : engine.communicator().gather(std::as_bytes(std::span(own)))) {
      const auto* theirs = reinterpret_cast<const double*>(bytes.data());
      for (std::size_t i = 0; i < all.size(); ++i) all[i] += theirs[i];
    }
    return all;
  }

  double error(double time)
  {
    double worst = 0;
    std::size_t k = 0;
    const std::vector<double> all = values();
    for_each(grid.cells(), [&](const Index& i) { worst = std::max(worst, std::abs(all[k++] - exact(i, time))); });
    return worst;
  }

  Grid grid;
  Executor executor;
  Engine engine;
};

}  // namespace tamp::test
