#include "tools/verify/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/console.hpp"
#include "tools/errors.hpp"
#include "tools/machine.hpp"
#include "tools/shipped_inputs.hpp"
#include "tools/study/run_study.hpp"
#include "tools/verify/verification_table.hpp"
#include "tools/version.hpp"

namespace tamp::tools::verify
{

namespace
{

namespace fs = std::filesystem;

/// The studies that there are, in the order of their names.
std::vector<fs::path> shipped_studies()
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(shipped_input("verification"))) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> chosen_studies(const std::vector<std::string>& names)
{
  const std::vector<fs::path> all = shipped_studies();
  if (names.empty()) return all;
  std::vector<std::string> known;
  for (const fs::path& file : all) known.push_back(file.stem());
  std::vector<fs::path> chosen;
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      throw InputError(
          {name, "no study of inputs/verification", fmt::format("expected one of {}", fmt::join(known, ", "))});
    }
    chosen.push_back(all[static_cast<std::size_t>(at - known.begin())]);
  }
  return chosen;
}

/// What the study found; a reference that failed is told, and keeps nothing else from being judged.
Json run_one(const VerifyOptions& options, const fs::path& file, std::vector<std::string>& failures)
{
  const fs::path folder = options.folder / file.stem();
  if (!options.quiet) print_err("{}\n", file.stem().string());
  study::StudyOptions study_options{file, folder, options.in_short, options.force, options.quiet};
  study_options.only_progress = true;
  try {
    study::run_study(study_options);
  } catch (const tasks::SimulationError& error) {
    failures.push_back(error.what());
  }
  Json study = Json::parse(std::ifstream(folder / "study.json"));
  for (const std::string& failure : failures_of(study)) {
    failures.push_back(study["name"].get<std::string>() + ": " + failure);
  }
  return study;
}

}  // namespace

void verify(const VerifyOptions& options)
{
  std::vector<Json> studies;
  std::vector<std::string> failures;
  std::size_t n_gates = 0;
  for (const fs::path& file : chosen_studies(options.names)) {
    studies.push_back(run_one(options, file, failures));
    n_gates += studies.back()["gates"].size();
  }
  const std::string table = to_markdown(studies);
  const Json json{{"program", version_text()},
                  {"machine", machine_json()},
                  {"short", options.in_short},
                  {"failures", failures},
                  {"studies", studies}};
  runtime::write_whole_file(options.folder / "verification.json", json.dump(1) + "\n");
  runtime::write_whole_file(options.folder / "verification.md", table);
  if (!options.quiet) print_out("{}", table);
  if (failures.empty()) return;
  throw tasks::SimulationError(
      fmt::format("{} of {} expectations do not hold:\n{}", failures.size(), n_gates, fmt::join(failures, "\n")), "",
      -1, {});
}

}  // namespace tamp::tools::verify
