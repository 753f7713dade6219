#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "tools/study/points.hpp"

namespace tamp::tools::study
{

/// How a point is measured.
struct Measurement {
  /// Why its settings are refused; empty where they are not.
  std::string refusal;
  /// Old words in its settings and in what is measured, a line each.
  std::vector<std::string> notes;
  /// A hash of all that its answers depend on, but for the program: what is measured with every default filled in, and
  /// the content of every file. Empty where it is refused.
  std::string key;
  /// The command line that remakes it, but for where the results go: `run SCENE --set ...`.
  std::vector<std::string> command;
};

/// Checks each point's settings, as the program would before it runs them. Throws InputError where what is measured
/// cannot be read without them, and for a pointer to a place that it does not have.
std::vector<Measurement> measurements_of(const Study& study, const std::vector<Point>& points);

/// The measured scene or material with these settings, every default filled in. Throws InputError where they are
/// refused.
Json resolved(const Measure& measure, const Settings& settings);

/// The command that remakes it, for people.
std::string command_text(const Measurement& measurement);

/// The measurement's command with its results in `folder`: `history.csv` and `summary.json` in this folder.
std::vector<std::string> command_into(const Study& study, const Measurement& measurement,
                                      const std::filesystem::path& folder);

}  // namespace tamp::tools::study
