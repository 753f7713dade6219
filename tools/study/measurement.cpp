#include "tools/study/measurement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "tools/scene/files/input_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/scene/materials/read_material.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/shell_word.hpp"

namespace tamp::tools::study
{

namespace
{

std::vector<std::string> assignments_of(const Settings& settings)
{
  std::vector<std::string> assignments;
  for (const auto& [pointer, value] : settings) assignments.push_back(pointer + "=" + value.dump());
  return assignments;
}

struct Measured {
  /// The scene or material with every default filled in.
  Json resolved;
  std::vector<std::string> notes;
};

Measured read_measured(const Measure& measure, const Settings& settings)
{
  const std::vector<std::string> assignments = assignments_of(settings);
  if (measure.kind == Measure::Kind::run) {
    CheckedScene scene = read_scene(measure.file, assignments);
    return {std::move(scene.resolved), std::move(scene.notes)};
  }
  CheckedMaterial material = read_checked_material(measure.file, assignments);
  return {std::move(material.resolved), std::move(material.notes)};
}

/// A place in a point's settings, as one in the study's file.
std::string place_in_study(const Study& study, const std::string& place)
{
  return place.starts_with("--set#") ? study.file.string() + place.substr(place.find('#')) : place;
}

/// A key of an object that is there, which may be new, or an item of a list.
bool is_place(const Json& document, const JsonPointer& pointer)
try {
  const JsonPointer above = pointer.parent_pointer();
  if (!document.contains(above)) return false;
  return document.at(above).is_object() ? pointer.back() != "-" : document.contains(pointer);
} catch (const Json::exception&) {  // an item whose number no list has
  return false;
}

/// Each pointer means something with the settings before it.
void expect_places(const Study& study, Json document, const Settings& settings)
{
  for (const auto& [pointer, value] : settings) {
    const JsonPointer place(pointer);
    if (!is_place(document, place)) {
      throw InputError({study.file.string() + "#", fmt::format("{}: there is no such place", pointer),
                        fmt::format("expected a JSON pointer into {}", study.measure.file.string())});
    }
    document[place] = value;
  }
}

/// A setting that no point has refines nothing.
void expect_refined(const Study& study, const std::vector<Point>& points)
{
  const auto has = [&](const Point& point) { return !point.setting(study.refine).is_null(); };
  if (study.refine.empty() || std::any_of(points.begin(), points.end(), has)) return;
  throw InputError({study.file.string() + "#/refine", fmt::format("{}, which no point sets", study.refine),
                    "expected a JSON pointer that is swept"});
}

/// A key that nobody knows is a mistake of the study; other settings that are refused are an answer.
void expect_known_keys(const Study& study, const InputError& refused)
{
  std::vector<Problem> unknown;
  for (const Problem& problem : refused.problems) {
    if (problem.found != unknown_key) continue;
    unknown.push_back(problem);
    unknown.back().place = study.file.string() + "#" + problem.place.substr(problem.place.find('#') + 1);
  }
  if (!unknown.empty()) throw InputError(std::move(unknown));
}

std::vector<std::string> command_of(const Study& study, const Settings& settings)
{
  const Measure& measure = study.measure;
  std::vector<std::string> command;
  switch (measure.kind) {
    case Measure::Kind::run:
      command = {"run", measure.file.string(), "--threads", std::to_string(study.n_threads)};
      if (study.most_steps) command.insert(command.end(), {"--steps", std::to_string(*study.most_steps)});
      break;
    case Measure::Kind::drive:
      command = {"drive", measure.file.string(), measure.along.string(), "--increment",
                 fmt::format("{}", measure.increment)};
      break;
    case Measure::Kind::modulus:
      command = {"modulus", measure.file.string(), "--states", measure.along.string()};
      break;
  }
  for (const std::string& assignment : assignments_of(settings)) {
    command.insert(command.end(), {"--set", assignment});
  }
  return command;
}

std::string in_one_line(std::string text)
{
  for (std::size_t at = text.find('\n'); at != std::string::npos; at = text.find('\n', at)) text.replace(at, 1, "; ");
  return text;
}

Measurement measurement_of(const Study& study, const Settings& settings)
{
  Measurement measurement{"", {}, "", command_of(study, settings)};
  try {
    const Measured measured = read_measured(study.measure, settings);
    for (const std::string& note : measured.notes) measurement.notes.push_back(place_in_study(study, note));
    std::string text = json_text(measured.resolved) + std::to_string(study.n_threads);
    if (study.most_steps) text += fmt::format("{} steps", *study.most_steps);
    if (!study.measure.along.empty()) {
      text += read_input_file(study.measure.along) + fmt::format("{}", study.measure.increment);
    }
    measurement.key = hash_of(text);
  } catch (const InputError& error) {
    expect_known_keys(study, error);
    measurement.refusal = in_one_line(error.what());
  }
  return measurement;
}

}  // namespace

std::vector<Measurement> measurements_of(const Study& study, const std::vector<Point>& points)
{
  expect_refined(study, points);
  const Json base = read_measured(study.measure, {}).resolved;
  std::vector<Measurement> measurements;
  // To read a scene again takes time, as its models are made too.
  std::map<Settings, Measurement> known;
  for (const Point& point : points) {
    expect_places(study, base, point.settings);
    const auto [at, is_new] = known.try_emplace(point.settings);
    if (is_new) at->second = measurement_of(study, point.settings);
    measurements.push_back(at->second);
  }
  return measurements;
}

Json resolved(const Measure& measure, const Settings& settings)
{
  return read_measured(measure, settings).resolved;
}

std::string command_text(const Measurement& measurement)
{
  std::string text = "tamp";
  for (const std::string& word : measurement.command) text += " " + shell_word(word);
  return text;
}

std::vector<std::string> command_into(const Study& study, const Measurement& measurement,
                                      const std::filesystem::path& folder)
{
  std::vector<std::string> command = measurement.command;
  if (study.measure.kind == Measure::Kind::run) {
    command.insert(command.end(), {"--quiet", "--out", folder.string()});
  } else {
    command.insert(command.end(),
                   {"--out", (folder / "history.csv").string(), "--summary", (folder / "summary.json").string()});
  }
  return command;
}

}  // namespace tamp::tools::study
