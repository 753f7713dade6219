#pragma once

#include <filesystem>
#include <optional>

namespace tamp::tools::study
{

struct StudyOptions {
  std::filesystem::path file;
  /// By default `studies/` and the file's name.
  std::filesystem::path folder;
  bool in_short = false;
  /// A rehearsal: each run ends after so many steps, which shows that all of them can be run; nothing is judged.
  std::optional<long> most_steps{};
  /// Remove what another program has found.
  bool force = false;
  /// Print no progress, and not what was found.
  bool quiet = false;
};

/// Reads a study, runs what has no result yet, and fills its folder: `points.csv`, `study.json`, and the page with its
/// charts. Throws InputError before anything runs; FileError; Interrupted, with all results so far kept; and
/// SimulationError, after all is written, for a reference that is not done.
void run_study(const StudyOptions& options);

}  // namespace tamp::tools::study
