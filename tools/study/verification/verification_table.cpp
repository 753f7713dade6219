#include "tools/study/verification/verification_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "tools/system/markdown_table.hpp"

namespace tamp::tools::verify
{

namespace
{

using Cells = std::vector<std::string>;

bool is_known_to_miss(const Json& result)
{
  return !result["missed"].get<std::string>().empty();
}

bool is_failure(const Json& result)
{
  return result["holds"] == false && !is_known_to_miss(result);
}

bool is_known_miss(const Json& result)
{
  return result["holds"] == false && is_known_to_miss(result);
}

/// A line for each chosen result: found, expected, and the reason under a key.
template <class IsAskedFor>
std::vector<std::string> lines_of(const Json& study, const IsAskedFor& is_asked_for, const char* key_of_reason)
{
  std::vector<std::string> lines;
  for (const Json& result : study["gates"]) {
    if (!is_asked_for(result)) continue;
    const std::string reason = result[key_of_reason];
    lines.push_back(fmt::format("{}, {}: {}, expected {}{}", result["label"].get<std::string>(),
                                result["quantity"].get<std::string>(), result["note"].get<std::string>(),
                                result["expected"].get<std::string>(), reason.empty() ? "" : " (" + reason + ")"));
  }
  return lines;
}

/// A quantity of a study, with its points by method and refined setting.
class QuantityTable
{
 public:
  QuantityTable(const Json& study, const Json& quantity) : study_(study), quantity_(quantity)
  {
    for (const Json& point : study["points"]) {
      if (point["refine"].is_number()) spacings_.push_back(point["refine"]);
    }
    std::sort(spacings_.rbegin(), spacings_.rend());
    spacings_.erase(std::unique(spacings_.begin(), spacings_.end()), spacings_.end());
  }

  std::string text() const
  {
    std::vector<Cells> rows{head()};
    for (const Json& method : study_["methods"]) {
      if (!points_of(method["name"]).empty()) rows.push_back(row(method["name"]));
    }
    return fmt::format("{}, error{}:\n\n{}", quantity_["name"].get<std::string>(),
                       spacings_.empty() ? "" : " by " + study_["refine"]["name"].get<std::string>(),
                       markdown_table(rows));
  }

  void add_to(Json& list) const
  {
    for (const Json& method : study_["methods"]) {
      const std::string name = method["name"];
      const std::vector<Json> points = points_from_coarsest(name);
      if (points.empty()) continue;
      Json errors = Json::array();
      for (const Json& point : points) errors.push_back(error_of(point));
      const std::vector<Json> results = results_of(name);
      const Json expected = expected_order(results);
      list.push_back(
          {{"problem", study_["name"]},
           {"quantity", quantity_["name"]},
           {"method", name},
           {"order", order_of(name)},
           {"expected_order", expected},
           {"errors", errors},
           {"passed", results.empty() ? Json() : Json(std::none_of(results.begin(), results.end(), is_failure))}});
    }
  }

 private:
  Cells head() const
  {
    Cells cells{"method"};
    for (const double spacing : spacings_) {
      cells.push_back(fmt::format("{:.4g} {}", spacing, study_["refine"]["unit"].get<std::string>()));
    }
    if (spacings_.empty()) {
      cells.push_back("error");
    } else {
      cells.push_back("order");
    }
    cells.insert(cells.end(), {"expected", "holds", "ns a particle-step"});
    return cells;
  }

  Cells row(const std::string& method) const
  {
    const std::vector<Json> points = points_of(method);
    Cells cells{method};
    if (spacings_.empty()) cells.push_back(error_text(points.front()));
    for (const double spacing : spacings_) {
      const auto is_there = [&](const Json& point) { return point["refine"] == spacing; };
      const auto at = std::find_if(points.begin(), points.end(), is_there);
      cells.push_back(at == points.end() ? "" : error_text(*at));
    }
    if (!spacings_.empty()) cells.push_back(order_text(method));
    cells.push_back(expected_text(method));
    cells.push_back(verdict(method));
    cells.push_back(cost_text(points));
    return cells;
  }

  std::vector<Json> points_of(const std::string& method) const
  {
    std::vector<Json> points;
    for (const Json& point : study_["points"]) {
      if (point["method"] == method) points.push_back(point);
    }
    return points;
  }

  std::string error_text(const Json& point) const
  {
    if (point["ended"] != "done") return point["ended"];
    const auto error = point["errors"].find(quantity_["name"].get<std::string>());
    return error == point["errors"].end() ? "" : fmt::format("{:.2e}", error->get<double>());
  }

  Json error_of(const Json& point) const
  {
    const std::string name = quantity_["name"];
    return point["ended"] == "done" && point["errors"].contains(name) ? point["errors"][name] : Json();
  }

  std::vector<Json> points_from_coarsest(const std::string& method) const
  {
    std::vector<Json> points = points_of(method);
    if (spacings_.empty()) return points;
    std::sort(points.begin(), points.end(), [](const Json& a, const Json& b) { return a["refine"] > b["refine"]; });
    return points;
  }

  std::vector<Json> results_of(const std::string& method) const
  {
    std::vector<Json> results;
    for (const Json& result : study_["gates"]) {
      if (result["method"] == method && result["quantity"] == quantity_["name"]) results.push_back(result);
    }
    return results;
  }

  static bool is_of_order(const Json& result)
  {
    return result["kind"] == "order_at_least" || result["kind"] == "order_at_most";
  }

  /// The order that was judged, or else that of errors which fall from each to the next; null where there is neither.
  Json order_of(const std::string& method) const
  {
    for (const Json& result : results_of(method)) {
      if (is_of_order(result) && result["found"].is_number()) return result["found"];
    }
    for (const Json& fit : quantity_["orders"]) {
      if (fit["method"] == method && fit["order"].is_number()) return fit["order"];
    }
    return {};
  }

  static Json expected_order(const std::vector<Json>& results)
  {
    const auto result = std::find_if(results.begin(), results.end(), is_of_order);
    return result == results.end() ? Json() : (*result)["limit"];
  }

  std::string order_text(const std::string& method) const
  {
    const Json order = order_of(method);
    return order.is_null() ? "none" : fmt::format("{:.2f}", order.get<double>());
  }

  std::string expected_text(const std::string& method) const
  {
    std::vector<std::string> texts;
    for (const Json& result : results_of(method)) texts.push_back(result["expected"]);
    return fmt::format("{}", fmt::join(texts, ", "));
  }

  std::string verdict(const std::string& method) const
  {
    const std::vector<Json> results = results_of(method);
    if (results.empty()) return "";
    if (std::any_of(results.begin(), results.end(), is_failure)) return "**NO**";
    return std::any_of(results.begin(), results.end(), is_known_miss) ? "no, as known" : "yes";
  }

  /// Cost of the largest point that is done.
  static std::string cost_text(const std::vector<Json>& points)
  {
    double most = 0, seconds = 0;
    for (const Json& point : points) {
      if (point["ended"] != "done" || !point["cost"].contains("particle_steps")) continue;
      const double n = point["cost"]["particle_steps"];
      if (n <= most) continue;
      most = n;
      seconds = point["cost"]["core_s"];
    }
    return most > 0 ? fmt::format("{:.0f}", seconds / most * 1e9) : "";
  }

  const Json& study_;
  const Json& quantity_;
  /// Values of the refined setting, falling.
  std::vector<double> spacings_;
};

}  // namespace

std::string to_markdown(const std::vector<Json>& studies)
{
  std::string text;
  for (const Json& study : studies) {
    text += fmt::format("{}### {}: {}\n\n", text.empty() ? "" : "\n", study["name"].get<std::string>(),
                        study["title"].get<std::string>());
    for (const Json& quantity : study["quantities"]) text += QuantityTable(study, quantity).text() + "\n";
    for (const std::string& failure : failures_of(study)) text += "- does not hold: " + failure + "\n";
    for (const std::string& miss : known_misses_of(study)) text += "- missed, as known: " + miss + "\n";
    for (const std::string& held : held_misses_of(study)) text += "- holds, though known to be missed: " + held + "\n";
  }
  return text;
}

Json to_list(const std::vector<Json>& studies)
{
  Json list = Json::array();
  for (const Json& study : studies) {
    for (const Json& quantity : study["quantities"]) QuantityTable(study, quantity).add_to(list);
  }
  return list;
}

std::vector<std::string> failures_of(const Json& study)
{
  return lines_of(study, is_failure, "why");
}

std::vector<std::string> known_misses_of(const Json& study)
{
  return lines_of(study, is_known_miss, "missed");
}

std::vector<std::string> held_misses_of(const Json& study)
{
  return lines_of(
      study, [](const Json& result) { return result["holds"] == true && is_known_to_miss(result); }, "missed");
}

}  // namespace tamp::tools::verify
