#include "tools/study/stability/stability.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/study/stability/catalogue.hpp"
#include "tools/system/console.hpp"
#include "tools/system/machine.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::stability
{

namespace
{

namespace fs = std::filesystem;

/// Read before anything runs, so that all mistakes are told first.
std::vector<study::Study> read_entries(const std::vector<fs::path>& files)
{
  std::vector<study::Study> entries;
  std::vector<Problem> problems;
  for (const fs::path& file : files) {
    try {
      entries.push_back(study::read_study(file, false));
      if (entries.back().stability) continue;
      problems.push_back({file.string() + "#/stability", "missing", "expected what fails, and what survives"});
    } catch (const InputError& error) {
      problems.insert(problems.end(), error.problems.begin(), error.problems.end());
    }
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return entries;
}

/// Differences from what was expected, in words.
std::string what_differs(const Entry& entry)
{
  const auto found = [](const Outcome& outcome) {
    return outcome.error ? fmt::format("an error of {:.3g}", *outcome.error) : outcome.ended;
  };
  std::vector<std::string> parts;
  if (!entry.failed()) {
    parts.push_back(fmt::format("{}: {}, expected {:.3g} at least, or unstable", entry.expected.fails,
                                found(entry.failing), clearly * entry.expected.threshold));
  }
  if (!entry.survived()) {
    parts.push_back(fmt::format("{}: {}, expected less than {:.3g}", entry.expected.survives, found(entry.surviving),
                                entry.expected.threshold / clearly));
  }
  return fmt::format("{}: {}", entry.name, fmt::join(parts, "; "));
}

}  // namespace

void run_catalogue(const study::StudyBatch& batch)
{
  const std::vector<fs::path> files = chosen_studies(batch);
  const std::vector<study::Study> studies = read_entries(files);
  note_shipped_inputs();
  expect_outputs({{"--json", batch.json}});
  make_folder(batch, {"stability.json", "stability.md", "monitors.md"});
  std::vector<std::string> failures = run_studies(batch, files);
  std::vector<Entry> entries;
  for (std::size_t i = 0; i < files.size(); ++i) {
    entries.push_back(entry_of(studies[i], results_of(batch, files[i]), batch.folder / files[i].stem()));
    if (!entries.back().is_as_expected()) failures.push_back(what_differs(entries.back()));
  }
  const std::string table = to_markdown(entries);
  const Json json{
      {"program", version_text()}, {"machine", machine_json()}, {"failures", failures}, {"entries", to_json(entries)}};
  runtime::write_whole_file(batch.folder / "stability.json", json_text(json, 1) + "\n");
  runtime::write_whole_file(batch.folder / "stability.md", table);
  runtime::write_whole_file(batch.folder / "monitors.md", monitors_to_markdown(entries));
  if (!batch.json.empty()) runtime::write_whole_file(batch.json, json_text(to_list(entries), 1) + "\n");
  if (!batch.quiet) print_out("{}", table);
  if (failures.empty() || batch.most_steps) return;
  throw tasks::SimulationError(fmt::format("{} of {} entries do not fail and survive as told:\n{}", failures.size(),
                                           entries.size(), fmt::join(failures, "\n")),
                               "", -1, {});
}

}  // namespace tamp::tools::stability
