#include "tools/study/stability/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/scene/json/print_json.hpp"
#include "tools/study/point_results.hpp"
#include "tools/system/markdown_table.hpp"

namespace tamp::tools::stability
{

namespace
{

const Json& point_of(const Json& results, const std::string& method)
{
  const Json& points = results["points"];
  return *std::find_if(points.begin(), points.end(), [&](const Json& point) { return point["method"] == method; });
}

/// The monitors in the summary of a point; none where it has no summary.
Json monitors_of(const Json& point, const std::filesystem::path& folder)
{
  const std::filesystem::path own = folder / point["folder"].get<std::string>();
  if (!std::filesystem::exists(own / "summary.json")) return Json::object();
  return study::summary_in(own).value("monitors", Json::object());
}

std::optional<double> count_of(const std::string& monitor, const Json& monitors)
{
  const Json found = monitors.value(monitor, Json());
  const Json count = found.is_object() ? found.value("count", Json()) : Json();
  return count.is_number() ? std::optional<double>(count) : std::nullopt;
}

Outcome outcome_of(const Json& point, const std::string& quantity, const Json& monitors)
{
  Outcome outcome{point["ended"], std::nullopt, point["command"]};
  const auto error = point["errors"].find(quantity);
  if (outcome.ended == "done" && error != point["errors"].end() && error->is_number()) outcome.error = *error;
  for (const auto& [name, monitor] : monitors.items()) {
    if (!monitor.is_object() || !monitor.contains("limit")) continue;
    outcome.shares_of_limits[name] = monitor["share"].get<double>() / monitor["limit"].get<double>();
  }
  return outcome;
}

std::string error_text(const Outcome& outcome)
{
  if (outcome.ended != "done") return outcome.ended;
  return outcome.error ? fmt::format("{:.2g}", *outcome.error) : "none";
}

Json outcome_json(const std::string& method, const Outcome& outcome)
{
  return {{"method", method},
          {"ended", outcome.ended},
          {"error", or_null(outcome.error)},
          {"command", outcome.command},
          {"shares_of_limits", outcome.shares_of_limits}};
}

}  // namespace

bool Entry::failed() const
{
  return failing.ended == "unstable" || (failing.error && *failing.error >= clearly * expected.threshold);
}

bool Entry::survived() const
{
  return surviving.error && *surviving.error < expected.threshold / clearly;
}

Entry entry_of(const study::Study& study, const Json& results, const std::filesystem::path& folder)
{
  const study::Stability& expected = *study.stability;
  const Json& failing = point_of(results, expected.fails);
  const Json& surviving = point_of(results, expected.survives);
  const Json monitors = monitors_of(failing, folder);
  return {study.file.stem(),
          study.title,
          expected,
          outcome_of(failing, expected.quantity, monitors),
          outcome_of(surviving, expected.quantity, monitors_of(surviving, folder)),
          count_of(expected.monitor, monitors)};
}

std::string to_markdown(const std::vector<Entry>& entries)
{
  std::vector<std::vector<std::string>> rows{
      {"entry", "fails", "error", "threshold", "survives", "error", "symptom", "as told"}};
  for (const Entry& entry : entries) {
    rows.push_back({entry.name, entry.expected.fails, error_text(entry.failing),
                    fmt::format("{:.2g}", entry.expected.threshold), entry.expected.survives,
                    error_text(entry.surviving), entry.expected.symptom, entry.is_as_expected() ? "yes" : "**NO**"});
  }
  return markdown_table(rows);
}

std::string monitors_to_markdown(const std::vector<Entry>& entries)
{
  struct Seen {
    double share = 0;
    std::string words;
  };
  std::map<std::string, std::pair<Seen, Seen>> next_to_limit;  // warning, and silent
  const auto look = [&](const Entry& entry, const std::string& method, const Outcome& outcome, bool survives) {
    for (const auto& [monitor, share] : outcome.shares_of_limits) {
      auto& [warning, silent] = next_to_limit[monitor];
      const Seen seen{share, fmt::format("{}, {} ({})", entry.name, method, error_text(outcome))};
      if (share > 1 && (warning.words.empty() || share < warning.share)) warning = seen;
      if (share <= 1 && survives && (silent.words.empty() || share > silent.share)) silent = seen;
    }
  };
  for (const Entry& entry : entries) {
    look(entry, entry.expected.fails, entry.failing, false);
    look(entry, entry.expected.survives, entry.surviving, entry.survived());
  }
  const auto share_text = [](const Seen& seen) { return seen.words.empty() ? "" : fmt::format("{:.2g}", seen.share); };
  std::vector<std::vector<std::string>> rows{
      {"monitor", "share / limit", "warns in (error)", "share / limit", "silent in (error)"}};
  for (const auto& [monitor, seen] : next_to_limit) {
    rows.push_back({monitor, share_text(seen.first), seen.first.words, share_text(seen.second), seen.second.words});
  }
  return markdown_table(rows);
}

Json to_json(const std::vector<Entry>& entries)
{
  Json all = Json::array();
  for (const Entry& entry : entries) {
    all.push_back({{"name", entry.name},
                   {"title", entry.title},
                   {"quantity", entry.expected.quantity},
                   {"threshold", entry.expected.threshold},
                   {"symptom", entry.expected.symptom},
                   {"monitor", entry.expected.monitor},
                   {"first_count", or_null(entry.first_count)},
                   {"fails", outcome_json(entry.expected.fails, entry.failing)},
                   {"failed", entry.failed()},
                   {"survives", outcome_json(entry.expected.survives, entry.surviving)},
                   {"survived", entry.survived()}});
  }
  return all;
}

Json to_list(const std::vector<Entry>& entries)
{
  Json list = Json::array();
  for (const Entry& entry : entries) {
    list.push_back({{"name", entry.name},
                    {"failing_method", entry.expected.fails},
                    {"symptom", entry.expected.symptom},
                    {"failed", entry.failed()},
                    {"surviving_method", entry.expected.survives},
                    {"survived", entry.survived()},
                    {"monitor", entry.expected.monitor},
                    {"first_count", or_null(entry.first_count)}});
  }
  return list;
}

}  // namespace tamp::tools::stability
