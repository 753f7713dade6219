#include "tools/study/run_study.hpp"

#include <fmt/format.h>

#include <set>

#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/study/run_points.hpp"
#include "tools/study/study_folder.hpp"
#include "tools/study/study_map_report.hpp"
#include "tools/study/study_report.hpp"
#include "tools/system/charts.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/shell_word.hpp"

namespace tamp::tools::study
{

namespace
{

std::string command_of(const StudyOptions& options)
{
  return fmt::format("tamp study {}{}{}{}", shell_word(options.file.string()), options.in_short ? " --short" : "",
                     options.most_steps ? fmt::format(" --steps {}", *options.most_steps) : "",
                     options.folder.empty() ? "" : " --out " + shell_word(options.folder.string()));
}

/// Refuses outputs that cannot be written before anything runs.
void expect_sound_reference(const Study& study, const std::vector<Point>& points,
                            const std::vector<Measurement>& measurements)
{
  for (std::size_t i = 0; i < points.size(); ++i) {
    const bool is_of_reference = points[i].role == Point::Role::reference || points[i].role == Point::Role::witness;
    if (!is_of_reference || measurements[i].refusal.empty()) continue;
    throw InputError({study.file.string() + "#/reference", measurements[i].refusal, "expected runs that can be done"});
  }
}

/// Prints each note once, however many points have it.
void print_notes_of(const std::vector<Measurement>& measurements)
{
  std::set<std::string> notes;
  for (const Measurement& measurement : measurements) notes.insert(measurement.notes.begin(), measurement.notes.end());
  print_notes({notes.begin(), notes.end()});
}

StudyResults measure_all(const Study& study, const StudyOptions& options, const std::filesystem::path& folder,
                         const std::filesystem::path& cache)
{
  const std::vector<Point> points = points_of(study);
  StudyResults results{study, command_of(options), {}, measurements_of(study, points), {}, {}};
  print_notes_of(results.measurements);
  expect_sound_reference(study, points, results.measurements);
  // Before hours of runs, not after them; all that the study reads has been read.
  expect_results(folder, {"points.csv", "study.json", "gates.csv", "map.csv", "index.html"});
  const auto measured = run_points(study, points, results.measurements, cache, options.quiet);
  for (std::size_t i = 0; i < points.size(); ++i) results.points.push_back({points[i], measured[i]});
  results.findings = findings_of(study, results.points);
  results.map = map_of(study, results.points, results.findings);
  results.expectations = judge_expectations(study, results.points, results.findings);
  return results;
}

void write(const StudyResults& results, const std::filesystem::path& folder)
{
  runtime::write_whole_file(folder / "points.csv", to_csv(results));
  runtime::write_whole_file(folder / "study.json", json_text(to_json(results), 1) + "\n");
  if (results.study.map) runtime::write_whole_file(folder / "map.csv", map_to_csv(results));
  if (!results.expectations.empty()) runtime::write_whole_file(folder / "gates.csv", expectations_to_csv(results));
}

/// A study whose reference has failed shows its points, and is no success.
void throw_if_reference_failed(const StudyResults& results)
{
  for (const MeasuredPoint& one : results.points) {
    if (one.point.role != Point::Role::reference || one.done()) continue;
    throw tasks::SimulationError(fmt::format("the reference, {}, ended with {}: {}", one.point.run_name(),
                                             to_text(one.result.end), one.result.reason),
                                 "", -1, {});
  }
}

/// Throws, where no point of the charts ran, the reasons for which they were refused, each once.
void throw_if_none_ran(const StudyResults& results)
{
  std::vector<Problem> problems{{results.study.file.string(), "no point ran", "expected settings that can be run"}};
  std::set<std::string> reasons;
  for (const auto& [point, result] : results.points) {
    if (point.role != Point::Role::chart) continue;
    if (result.end != End::refused) return;
    if (reasons.insert(result.reason).second) problems.push_back({point.name(), result.reason, ""});
  }
  if (!reasons.empty()) throw InputError(std::move(problems));
}

}  // namespace

void run_study(const StudyOptions& options)
{
  Study study = read_study(options.file, options.in_short);
  study.most_steps = options.most_steps;
  const std::filesystem::path folder =
      options.folder.empty() ? std::filesystem::path("studies") / study.file.stem() : options.folder;
  const StudyFolder own(folder, options.force);
  const StudyResults results = measure_all(study, options, folder, own.points());
  write(results, folder);
  if (!options.quiet) print_out("{}", to_text(results));
  draw_page(folder);
  if (!options.quiet) print_out("  written to {}: index.html, points.csv, charts\n", folder.string());
  if (!options.most_steps) throw_if_reference_failed(results);
  throw_if_none_ran(results);
}

}  // namespace tamp::tools::study
