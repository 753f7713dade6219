#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "tools/scene/json/document.hpp"
#include "tools/study/study.hpp"

/// The failure catalogue: what is expected of methods, and whether they did it.
namespace tamp::tools::stability
{

/// Factor by which errors have to be away from the threshold, on either side: errors near it are neither failure nor
/// cure.
inline constexpr double clearly = 3;

/// How a method ended, and how far it was off.
struct Outcome {
  /// As the study has it: "done", "unstable", "limit", "refused".
  std::string ended;
  /// Its error; empty where it has none.
  std::optional<double> error;
  /// The command line that remakes it.
  std::string command;
  /// The monitors' shares over their limits, by name, where it is the run of a scene.
  std::map<std::string, double> shares_of_limits{};
};

/// An entry of the catalogue with what its study has found.
struct Entry {
  std::string name, title;
  study::Stability expected;
  Outcome failing, surviving;
  /// The count of its monitor in the run that fails, where it has one.
  std::optional<double> first_count;

  /// Unstable, or three times as far off as the threshold or more.
  bool failed() const;
  /// Done, and within a third of the threshold.
  bool survived() const;
  bool is_as_expected() const { return failed() && survived(); }
};

/// `results` is the `study.json` of a study in `folder`. Throws FileError where a summary there cannot be read.
Entry entry_of(const study::Study& study, const Json& results, const std::filesystem::path& folder);

/// A table in Markdown, a row for each entry.
std::string to_markdown(const std::vector<Entry>& entries);

/// A table in Markdown, a row for each monitor: of the runs in which it warns, and of those that survive in which it
/// does not, those whose shares are next to its limit.
std::string monitors_to_markdown(const std::vector<Entry>& entries);

/// All data of each entry, with titles and commands.
Json to_json(const std::vector<Entry>& entries);

/// For each entry `{name, failing_method, symptom, failed, surviving_method, survived, monitor, first_count}`, the
/// count null where there is none.
Json to_list(const std::vector<Entry>& entries);

}  // namespace tamp::tools::stability
