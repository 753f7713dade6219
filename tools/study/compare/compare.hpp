#pragma once

#include <filesystem>
#include <limits>
#include <memory>
#include <vector>

#include "tools/run/run_folder.hpp"
#include "tools/study/compare/comparison.hpp"
#include "tools/study/compare/model_scenes.hpp"

namespace tamp::tools::compare
{

struct Options {
  std::filesystem::path folder;
  bool force = false;
  int n_threads = 1;
  /// Stop at this simulated time [s] if the scene ends later.
  double until = std::numeric_limits<double>::infinity();
  /// Stop each model after so many steps.
  long max_steps = std::numeric_limits<long>::max();
  bool quiet = false;
};

/// Makes the folder of a comparison, and one in it for each model, to be kept as long as something is written into
/// them. Throws what RunFolder throws; with `options.force` an earlier comparison is replaced.
std::vector<std::unique_ptr<RunFolder>> prepare_folders(const Options& options, const std::vector<ModelScene>& scenes);

/// Runs the scenes side by side in one process, in rounds. In each round every model goes through the same simulated
/// time: one leads with some steps and the others follow to where it arrived; leader and order change from round to
/// round, so that what else the machine does hits all alike. A simulation that goes wrong ends there, and the others
/// go on. Throws FileError.
Comparison compare(const std::vector<ModelScene>& scenes, const Options& options);

}  // namespace tamp::tools::compare
