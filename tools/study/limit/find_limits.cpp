#include "tools/study/limit/find_limits.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/storage/whole_file.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/parse_json.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/study/limit/limit_report.hpp"
#include "tools/study/measurement.hpp"
#include "tools/study/quantities.hpp"
#include "tools/study/reference.hpp"
#include "tools/study/run_points.hpp"
#include "tools/study/study_folder.hpp"
#include "tools/system/console.hpp"
#include "tools/system/shell_word.hpp"

namespace tamp::tools::study
{

namespace
{

namespace fs = std::filesystem;

/// A scene alone, as a study of one method.
Study study_of_scene(const fs::path& file)
{
  Study study;
  study.file = study.measure.file = file;
  study.title = file.stem().string();
  study.methods.push_back({study.title, study.title, false, {}, {}, {}});
  return study;
}

Study read_study_or_scene(const StudyOptions& options)
{
  const Json document = parse_json(options.file);
  const bool is_study = document.is_object() && document.contains("measure");
  if (is_study) return read_study(options.file, options.in_short);
  if (options.in_short) throw InputError({"--short", "given with a scene", "expected a study"});
  return study_of_scene(options.file);
}

void expect_runs(const Study& study)
{
  if (study.measure.kind == Measure::Kind::run) return;
  throw InputError({study.file.string() + "#/measure", "what is no run of a scene", "expected the key run"});
}

bool sweeps(const Method& method, const std::string& pointer)
{
  return std::any_of(method.sweep.begin(), method.sweep.end(),
                     [&](const Axis& axis) { return axis.pointer == pointer; });
}

/// The points that a limit is found for: all other combinations of the methods that sweep the setting; where none does,
/// the first point of each method.
std::vector<Point> points_with_a_limit(Study study, const std::string& pointer)
{
  const auto does = [&](const Method& method) { return sweeps(method, pointer); };
  const bool is_swept = std::any_of(study.methods.begin(), study.methods.end(), does);
  if (is_swept) std::erase_if(study.methods, [&](const Method& method) { return !does(method); });
  for (Method& method : study.methods) {
    std::erase_if(method.sweep, [&](const Axis& axis) { return axis.pointer == pointer; });
  }
  std::vector<Point> points;
  for (Point& point : points_of(study)) {
    const auto is_of = [&](const Point& other) { return other.method == point.method; };
    const bool is_first = std::none_of(points.begin(), points.end(), is_of);
    if (point.role == Point::Role::chart && (is_swept || is_first)) points.push_back(std::move(point));
  }
  return points;
}

/// The value of the setting in the scene, with every default filled in.
double value_as_written(const Study& study, const Point& point, const std::string& pointer)
{
  const Json scene = resolved(study.measure, point.settings);
  const std::string expected = "expected a JSON pointer to a number above 0 of " + study.measure.file.string();
  const Json* const value = find_value(scene, pointer);
  if (value == nullptr) throw InputError({"--limit", fmt::format("{}: there is no such place", pointer), expected});
  if (!value->is_number() || !(value->get<double>() > 0)) {
    throw InputError({"--limit", fmt::format("{} is {}", pointer, value->dump()), expected});
  }
  return value->get<double>();
}

Point with_value(Point point, const std::string& pointer, double value)
{
  point.settings = merged(point.settings, {{pointer, value}});
  return point;
}

/// Throws for settings that would be refused, before anything runs.
void expect_accepted(const Study& study, const std::vector<Point>& points, const LimitOptions& limit)
{
  if (!limit.search.between) return;
  for (const Point& point : points) {
    for (const double end : {limit.search.between->first, limit.search.between->second}) {
      const std::string refusal = measurements_of(study, {with_value(point, limit.pointer, end)}).front().refusal;
      if (!refusal.empty()) throw InputError({"--between", refusal, "expected values that the scene may have"});
    }
  }
}

class Prober
{
 public:
  Prober(const Study& study, std::string pointer, fs::path cache, bool quiet)
      : study_(study), pointer_(std::move(pointer)), cache_(std::move(cache)), quiet_(quiet)
  {
  }

  Probe probe(const Point& point, double value) const
  {
    const Point changed = with_value(point, pointer_, value);
    const std::vector<Measurement> measured = measurements_of(study_, {changed});
    const PointResult result = run_points(study_, {changed}, measured, cache_, true).front();
    Probe probe{value, Probe::Verdict::stable, result.reason, command_text(measured.front())};
    if (result.end == End::done) {
      judge(result, probe);
    } else {
      probe.verdict = result.end == End::unstable ? Probe::Verdict::unstable : Probe::Verdict::no_answer;
    }
    if (!quiet_) {
      print_err("{}: {} {}: {}{}\n", point.name(), pointer_name(pointer_), value, to_text(probe.verdict),
                probe.why.empty() ? "" : ", " + probe.why);
    }
    return probe;
  }

 private:
  /// Judges a run that came to its end.
  void judge(const PointResult& result, Probe& probe) const
  {
    const StableIf& stable = study_.stable_if;
    const auto fail = [&](std::string why) {
      probe.verdict = Probe::Verdict::unstable;
      probe.why = std::move(why);
    };
    const Json summary = summary_in(result.folder);
    const std::string status = summary.at("status");
    if (!status.starts_with("completed")) return fail(status);
    probe.energy_error = summary.at("energy_error").get<double>();
    if (stable.energy_error && !(*probe.energy_error <= *stable.energy_error)) {
      fail(fmt::format("the energy is wrong by {:.3g} %", *probe.energy_error * 100));
    }
    if (stable.quantity.empty()) return;
    const Quantity& quantity = *std::find_if(study_.quantities.begin(), study_.quantities.end(),
                                             [&](const Quantity& one) { return one.name == stable.quantity; });
    probe.error = reference_of(study_, quantity, {}).error(quantity, answer_of(study_, quantity, result));
    if (!(*probe.error <= *stable.error)) fail(fmt::format("error of {} {:.3g}", quantity.name, *probe.error));
  }

  const Study& study_;
  std::string pointer_;
  fs::path cache_;
  bool quiet_;
};

std::string command_of(const StudyOptions& options, const LimitOptions& limit)
{
  std::string text = fmt::format("tamp study {}{} --limit {}", shell_word(options.file.string()),
                                 options.in_short ? " --short" : "", shell_word(limit.pointer));
  if (limit.search.between) {
    text += fmt::format(" --between {},{}", limit.search.between->first, limit.search.between->second);
  }
  text += fmt::format(" --within {} --runs {}", limit.search.within, limit.search.most_runs);
  if (limit.energy_error) text += fmt::format(" --energy-error {}", *limit.energy_error);
  return text + (options.folder.empty() ? "" : " --out " + shell_word(options.folder.string()));
}

void throw_where_there_is_none(const LimitResults& results)
{
  std::vector<Problem> problems;
  for (const Limit& limit : results.limits) {
    if (limit.edge) continue;
    problems.push_back({results.search.between ? "--between" : "--limit", limit.method + ": " + limit.note,
                        "expected values of which one is stable and another is not"});
  }
  if (!problems.empty()) throw InputError(std::move(problems));
}

}  // namespace

void find_limits(const StudyOptions& options, const LimitOptions& limit)
{
  Study study = read_study_or_scene(options);
  expect_runs(study);
  study.repeat = 1;
  study.refine.clear();
  if (limit.energy_error) study.stable_if.energy_error = limit.energy_error;
  const std::vector<Point> points = points_with_a_limit(study, limit.pointer);
  std::vector<double> written;
  written.reserve(points.size());
  for (const Point& point : points) written.push_back(value_as_written(study, point, limit.pointer));
  expect_accepted(study, points, limit);

  const fs::path folder =
      options.folder.empty() ? fs::path("studies") / (study.file.stem().string() + "-limit") : options.folder;
  const StudyFolder own(folder, options.force);
  expect_results(folder, {"limit.json", "limit.csv"});
  const Prober prober(study, limit.pointer, own.points(), options.quiet);
  LimitResults results{study, command_of(options, limit), limit.pointer, limit.search, {}};
  for (std::size_t i = 0; i < points.size(); ++i) {
    results.limits.push_back(search_limit(points[i].name(), written[i], limit.search,
                                          [&](double value) { return prober.probe(points[i], value); }));
  }
  runtime::write_whole_file(folder / "limit.json", json_text(to_json(results), 1) + "\n");
  runtime::write_whole_file(folder / "limit.csv", to_csv(results));
  if (!options.quiet) print_out("{}  written to {}: limit.json, limit.csv\n", to_text(results), folder.string());
  throw_where_there_is_none(results);
}

}  // namespace tamp::tools::study
