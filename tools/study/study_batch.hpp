#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "tools/scene/json/document.hpp"

namespace tamp::tools::study
{

/// Shipped studies that run one after another, or some at once, each into a folder of its own.
struct StudyBatch {
  /// Which of the shipped inputs they are: "verification".
  std::string inputs;
  /// Holds a folder for each study, and what is written about all of them.
  std::filesystem::path folder;
  /// Names of studies, without their ending; all where empty.
  std::vector<std::string> names{};
  /// Where a list of results is written too; empty: nowhere.
  std::filesystem::path json{};
  bool in_short = false;
  /// A rehearsal, see StudyOptions; what the studies have found is not judged.
  std::optional<long> most_steps{};
  /// Remove what another program has found.
  bool force = false;
  bool quiet = false;
  /// How many studies run at once; 0 for as many as there are cores.
  int n_jobs = 0;
};

/// The files of the chosen studies, each once, in the order of their names where all are. Throws InputError for a name
/// that is no study's.
std::vector<std::filesystem::path> chosen_studies(const StudyBatch& batch);

/// Makes the batch's folder, and throws as expect_results does where one of the files that are to be written there
/// could not be: before the studies run, not after them.
void make_folder(const StudyBatch& batch, const std::vector<std::string>& outputs);

/// Runs the studies as `tamp study` does, in processes of their own, as HDF5 works on one thread at a time. Returns a
/// line for each whose reference failed, which keeps nothing else from being judged. Throws InputError, FileError and
/// Interrupted as the studies do.
std::vector<std::string> run_studies(const StudyBatch& batch, const std::vector<std::filesystem::path>& files);

/// The results of a study, its `study.json`.
Json results_of(const StudyBatch& batch, const std::filesystem::path& file);

}  // namespace tamp::tools::study
