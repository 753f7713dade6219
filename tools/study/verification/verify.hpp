#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace tamp::tools::verify
{

struct VerifyOptions {
  /// Studies of inputs/verification, without their ending; all where empty.
  std::vector<std::string> names;
  /// Holds a folder for each study, `verification.json` and `verification.md`.
  std::filesystem::path folder{"runs/verify"};
  /// Where a list of problems and methods, with orders and errors, is written too; empty: nowhere.
  std::filesystem::path json;
  bool in_short = false;
  /// Remove what another program has found.
  bool force = false;
  bool quiet = false;
  /// How many studies run at once; 0 for as many as there are cores.
  int n_jobs = 0;
};

/// Runs the studies of inputs/verification, as `tamp study` does, and writes and prints a table of what came out beside
/// what was expected. Throws InputError for a name that is no study's; FileError; Interrupted; and SimulationError,
/// after all is written, if an expectation does not hold that no study lists as missed. One that is listed and holds is
/// reported.
void verify(const VerifyOptions& options);

}  // namespace tamp::tools::verify
