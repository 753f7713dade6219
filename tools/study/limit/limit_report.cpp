#include "tools/study/limit/limit_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/scene/json/print_json.hpp"
#include "tools/scene/tables/csv_text.hpp"
#include "tools/system/machine.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::study
{

namespace
{

Json probe_json(const Probe& probe)
{
  return {{"value", probe.value},
          {"verdict", to_text(probe.verdict)},
          {"why", probe.why},
          {"energy_error", or_null(probe.energy_error)},
          {"error", or_null(probe.error)},
          {"command", probe.command}};
}

/// The columns of the table, and the figures of a method in limit.json.
Json figures(const Limit& limit)
{
  Json json{
      {"method", limit.method},      {"written", limit.written},  {"written_is", to_text(limit.probes.front().verdict)},
      {"last_stable", nullptr},      {"first_unstable", nullptr}, {"written_over_last_stable", nullptr},
      {"runs", limit.probes.size()}, {"why", limit.note}};
  if (limit.edge) {
    json["last_stable"] = limit.edge->stable.value;
    json["first_unstable"] = limit.edge->unstable.value;
    json["written_over_last_stable"] = limit.written / limit.edge->stable.value;
    json["why"] = limit.edge->unstable.why;
  }
  return json;
}

Json criteria_json(const StableIf& stable)
{
  return {{"energy_error_at_most", or_null(stable.energy_error)},
          {"quantity", stable.quantity.empty() ? Json(nullptr) : Json(stable.quantity)},
          {"error_at_most", or_null(stable.error)}};
}

std::string number_or_dash(const Json& number)
{
  return number.is_null() ? "-" : fmt::format("{:.4g}", number.get<double>());
}

}  // namespace

Json to_json(const LimitResults& results)
{
  Json methods = Json::array();
  for (const Limit& limit : results.limits) {
    methods.push_back(figures(limit));
    Json& probes = methods.back()["probes"] = Json::array();
    for (const Probe& probe : limit.probes) probes.push_back(probe_json(probe));
  }
  return {{"name", results.study.file.stem().string()},
          {"title", results.study.title},
          {"command", results.command},
          {"program", version_text()},
          {"machine", machine_json()},
          {"limit", results.pointer},
          {"within", results.search.within},
          {"stable_if", criteria_json(results.study.stable_if)},
          {"methods", methods}};
}

std::string to_csv(const LimitResults& results)
{
  std::vector<CsvRow> rows;
  for (const Limit& limit : results.limits) rows.push_back(csv_row(figures(limit)));
  return csv_text(rows);
}

std::string to_text(const LimitResults& results)
{
  std::size_t width = std::string("method").size();
  for (const Limit& limit : results.limits) width = std::max(width, limit.method.size());
  std::string text = fmt::format("{}\n  limit of {}, within {:.3g} %\n", results.study.title, results.pointer,
                                 results.search.within * 100);
  text += fmt::format("  {:<{}}{:>12}{:>12}{:>13}{:>16}{:>16}{:>6}  {}\n", "method", width, "as written", "which is",
                      "last stable", "first unstable", "written/stable", "runs", "why it fails");
  for (const Limit& limit : results.limits) {
    const Json row = figures(limit);
    text += fmt::format("  {:<{}}{:>12.4g}{:>12}{:>13}{:>16}{:>16}{:>6}  {}\n", limit.method, width, limit.written,
                        row["written_is"].get<std::string>(), number_or_dash(row["last_stable"]),
                        number_or_dash(row["first_unstable"]), number_or_dash(row["written_over_last_stable"]),
                        limit.probes.size(), row["why"].get<std::string>());
  }
  return text;
}

}  // namespace tamp::tools::study
