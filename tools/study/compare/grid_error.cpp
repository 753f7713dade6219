#include "tools/study/compare/grid_error.hpp"

#include <fmt/format.h>

#include <limits>

#include "tools/study/compare/model_run.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools::compare
{

std::optional<ModelScene> coarser_scene(const std::filesystem::path& file, const ModelScene& scene)
{
  const runtime::Grid& grid = scene.scene.scene.grid;
  std::vector<std::string> assignments = scene.assignments;
  assignments.push_back(fmt::format("/grid/cell_size={}", 2 * grid.cell_size));
  assignments.emplace_back(grid.dimension == 2 ? "/grid/patches=[1,1]" : "/grid/patches=[1,1,1]");
  try {
    CheckedScene coarser = read_scene(file, assignments);
    return ModelScene{"coarser", assignments, std::move(coarser)};
  } catch (const InputError&) {
    return std::nullopt;
  }
}

ModelResult run_coarser(const ModelScene& scene, double until, int n_threads, const std::filesystem::path& folder)
{
  ModelRun run(scene, {until, std::numeric_limits<long>::max()}, folder,
               std::make_shared<runtime::Executor>(n_threads));
  run.advance_to(until);
  return run.result();
}

}  // namespace tamp::tools::compare
