#include "tools/study/stability/catalogue.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>

#include "runtime/file_error.hpp"
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

Outcome outcome_of(const Json& point, const std::string& quantity)
{
  Outcome outcome{point["ended"], std::nullopt, point["command"]};
  const auto error = point["errors"].find(quantity);
  if (outcome.ended == "done" && error != point["errors"].end() && error->is_number()) outcome.error = *error;
  return outcome;
}

std::optional<double> count_of(const std::string& monitor, const std::filesystem::path& run)
{
  const std::filesystem::path file = run / "summary.json";
  if (!std::filesystem::exists(file)) return std::nullopt;
  const Json summary = Json::parse(std::ifstream(file), nullptr, false);
  if (summary.is_discarded()) throw runtime::FileError(file.string(), "cannot be read");
  const Json count = summary.value("monitors", Json::object()).value(monitor, Json()).is_object()
                         ? summary["monitors"][monitor].value("count", Json())
                         : Json();
  return count.is_number() ? std::optional<double>(count) : std::nullopt;
}

std::string error_text(const Outcome& outcome)
{
  if (outcome.ended != "done") return outcome.ended;
  return outcome.error ? fmt::format("{:.2g}", *outcome.error) : "none";
}

Json value_or_null(const std::optional<double>& value)
{
  return value ? Json(*value) : Json();
}

Json outcome_json(const std::string& method, const Outcome& outcome)
{
  return {{"method", method},
          {"ended", outcome.ended},
          {"error", value_or_null(outcome.error)},
          {"command", outcome.command}};
}

}  // namespace

bool Entry::failed() const
{
  return failing.ended == "unstable" || (failing.error && *failing.error >= clearly * told.threshold);
}

bool Entry::survived() const
{
  return surviving.error && *surviving.error < told.threshold / clearly;
}

Entry entry_of(const study::Study& study, const Json& results, const std::filesystem::path& folder)
{
  const study::Stability& told = *study.stability;
  const Json& failing = point_of(results, told.fails);
  return {study.file.stem(),
          study.title,
          told,
          outcome_of(failing, told.quantity),
          outcome_of(point_of(results, told.survives), told.quantity),
          count_of(told.monitor, folder / failing["folder"].get<std::string>())};
}

std::string to_markdown(const std::vector<Entry>& entries)
{
  std::vector<std::vector<std::string>> rows{
      {"entry", "fails", "error", "threshold", "survives", "error", "symptom", "as told"}};
  for (const Entry& entry : entries) {
    rows.push_back({entry.name, entry.told.fails, error_text(entry.failing),
                    fmt::format("{:.2g}", entry.told.threshold), entry.told.survives, error_text(entry.surviving),
                    entry.told.symptom, entry.is_as_told() ? "yes" : "**NO**"});
  }
  return markdown_table(rows);
}

Json to_json(const std::vector<Entry>& entries)
{
  Json all = Json::array();
  for (const Entry& entry : entries) {
    all.push_back({{"name", entry.name},
                   {"title", entry.title},
                   {"quantity", entry.told.quantity},
                   {"threshold", entry.told.threshold},
                   {"symptom", entry.told.symptom},
                   {"monitor", entry.told.monitor},
                   {"first_count", value_or_null(entry.first_count)},
                   {"fails", outcome_json(entry.told.fails, entry.failing)},
                   {"failed", entry.failed()},
                   {"survives", outcome_json(entry.told.survives, entry.surviving)},
                   {"survived", entry.survived()}});
  }
  return all;
}

Json to_list(const std::vector<Entry>& entries)
{
  Json list = Json::array();
  for (const Entry& entry : entries) {
    list.push_back({{"name", entry.name},
                    {"failing_method", entry.told.fails},
                    {"symptom", entry.told.symptom},
                    {"failed", entry.failed()},
                    {"surviving_method", entry.told.survives},
                    {"survived", entry.survived()},
                    {"monitor", entry.told.monitor},
                    {"first_count", value_or_null(entry.first_count)}});
  }
  return list;
}

}  // namespace tamp::tools::stability
