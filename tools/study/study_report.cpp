#include "tools/study/study_report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <set>

#include "tools/scene/json/print_json.hpp"
#include "tools/scene/tables/csv_text.hpp"
#include "tools/study/study_map_report.hpp"
#include "tools/system/machine.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::study
{

namespace
{

std::string kind_text(Reference::Kind kind)
{
  static constexpr std::array<const char*, 5> words{"none", "exact", "run", "finest", "extrapolated"};
  return words.at(static_cast<std::size_t>(kind));
}

Json reference_json(const Quantity& quantity, const Reference& reference)
{
  const bool has_value = reference.kind != Reference::Kind::none && !quantity.is_column();
  return {{"kind", kind_text(reference.kind)},
          {"value", has_value ? Json(reference.answer.value) : Json(nullptr)},
          {"uncertainty", or_null(reference.uncertainty)},
          {"order", or_null(reference.order)},
          {"bound", reference.bound},
          {"note", reference.note}};
}

Json orders_json(const QuantityFindings& found)
{
  Json all = Json::array();
  for (const OrderFit& fit : found.orders) {
    all.push_back({{"method", fit.method},
                   {"label", fit.label},
                   {"points", fit.points},
                   {"order", or_null(fit.order)},
                   {"cost_power", or_null(fit.cost_power)},
                   {"note", fit.note}});
  }
  return all;
}

Json quantities_json(const StudyResults& results)
{
  Json all = Json::array();
  for (std::size_t i = 0; i < results.study.quantities.size(); ++i) {
    const Quantity& quantity = results.study.quantities[i];
    const QuantityFindings& found = results.findings.quantities[i];
    all.push_back({{"name", quantity.name},
                   {"unit", unit_of(quantity)},
                   {"relative", found.reference.relative},
                   {"reference", reference_json(quantity, found.reference)},
                   {"orders", orders_json(found)}});
  }
  return all;
}

Json methods_json(const StudyResults& results)
{
  Json all = Json::array();
  for (const Method& method : results.study.methods) {
    all.push_back({{"name", method.name}, {"family", method.family}, {"dashed", method.dashed}, {"line", true}});
  }
  // Their points are of no method that one would choose.
  if (results.study.reference) {
    const bool is_one = !results.study.reference->of_each_method;
    all.push_back({{"name", reference_name}, {"family", reference_name}, {"dashed", true}, {"line", is_one}});
  }
  if (results.study.budget) {
    all.push_back({{"name", budget_name}, {"family", budget_name}, {"dashed", false}, {"line", false}});
  }
  return all;
}

/// Keys of all costs that are known, not only of those in the charts.
std::vector<std::string> cost_keys(Measure::Kind kind)
{
  switch (kind) {
    case Measure::Kind::run:
      return {"core_s", "particle_steps", "steps"};
    case Measure::Kind::drive:
      return {"core_s", "ns_per_update", "evaluations_per_update"};
    case Measure::Kind::modulus:
      return {"core_s", "ns_per_evaluation"};
  }
  return {};
}

Json cost_json(const StudyResults& results, const PointResult& result)
{
  Json cost = Json::object();
  for (const std::string& key : cost_keys(results.study.measure.kind)) {
    const auto spread = result.cost(key);
    if (!spread) continue;
    cost[key] = spread->median;
    cost[key + "_low"] = spread->least;
    cost[key + "_high"] = spread->greatest;
  }
  return cost;
}

Json point_json(const StudyResults& results, std::size_t i)
{
  const auto& [point, result] = results.points[i];
  const Json refine = results.study.refine.empty() ? Json(nullptr) : point.setting(results.study.refine);
  Json json{{"id", point.id},
            {"method", point.method},
            {"label", point.label},
            {"settings", Json::object()},
            {"refine", refine.is_number() ? refine : Json(nullptr)},
            {"ended", to_text(result.end)},
            {"reason", result.reason},
            {"cost", cost_json(results, result)},
            {"values", Json::object()},
            {"errors", Json::object()},
            {"differences", Json::array()},
            {"front", Json::array()},
            {"command", command_text(results.measurements[i])},
            {"folder", result.folder.empty() ? "" : "points/" + result.folder.filename().string()}};
  for (const auto& [pointer, value] : point.settings) json["settings"][pointer] = value;
  for (std::size_t q = 0; q < results.study.quantities.size(); ++q) {
    const std::string& name = results.study.quantities[q].name;
    const QuantityFindings& found = results.findings.quantities[q];
    if (found.values.contains(point.id)) json["values"][name] = found.values.at(point.id);
    if (found.errors.contains(point.id)) json["errors"][name] = found.errors.at(point.id);
    if (found.differences.contains(point.id)) json["differences"].push_back(name);
    if (std::count(found.front.begin(), found.front.end(), point.id) > 0) json["front"].push_back(name);
  }
  return json;
}

Json points_json(const StudyResults& results)
{
  Json all = Json::array();
  for (std::size_t i = 0; i < results.points.size(); ++i) all.push_back(point_json(results, i));
  return all;
}

Json budgets_json(const StudyResults& results)
{
  Json all = Json::array();
  for (const ErrorBudget& budget : results.findings.budgets) {
    const auto quantity = std::find_if(results.study.quantities.begin(), results.study.quantities.end(),
                                       [&](const Quantity& q) { return q.name == budget.quantity; });
    Json parts = Json::array();
    for (const BudgetAmount& part : budget.parts) {
      parts.push_back({{"name", part.name}, {"amount", or_null(part.amount)}, {"note", part.note}});
    }
    all.push_back({{"quantity", budget.quantity},
                   {"unit", unit_of(*quantity)},
                   {"of", budget.base},
                   {"value", or_null(budget.value)},
                   {"parts", parts}});
  }
  return all;
}

Json expectations_json(const StudyResults& results)
{
  Json all = Json::array();
  for (const ExpectationResult& result : results.expectations) {
    const bool has_limit = result.kind != Expectation::Kind::fails;
    all.push_back({{"quantity", result.quantity},
                   {"method", result.method},
                   {"label", result.label},
                   {"kind", to_text(result.kind)},
                   {"limit", has_limit ? Json(result.limit) : Json(nullptr)},
                   {"found", or_null(result.found)},
                   {"holds", result.holds},
                   {"expected", result.expected},
                   {"note", result.note},
                   {"why", result.why},
                   {"missed", result.missed}});
  }
  return all;
}

Json costs_json(const Study& study)
{
  Json all = Json::array();
  for (const CostKind& kind : cost_kinds(study.measure.kind)) {
    all.push_back({{"key", kind.key}, {"name", kind.name}, {"unit", kind.unit}});
  }
  return all;
}

/// Unit of a setting, for pointers to a scene's lengths and times.
std::string unit_of_pointer(const std::string& pointer)
{
  if (pointer.ends_with("/cell_size")) return "m";
  return pointer.ends_with("/maximum_step") ? "s" : "";
}

Json refine_json(const Study& study)
{
  if (study.refine.empty()) return nullptr;
  return {{"pointer", study.refine}, {"name", pointer_name(study.refine)}, {"unit", unit_of_pointer(study.refine)}};
}

/// The pointers that points differ in, in the order in which they come.
std::vector<std::string> pointers_of(const StudyResults& results)
{
  std::vector<std::string> all;
  std::set<std::string> seen;
  for (const MeasuredPoint& one : results.points) {
    for (const auto& [pointer, value] : one.point.settings) {
      if (seen.insert(pointer).second) all.push_back(pointer);
    }
  }
  return all;
}

/// A row of `points.csv`.
CsvRow row_of(const StudyResults& results, const Json& point, const std::vector<std::string>& pointers)
{
  CsvRow row{{"id", point["id"]}, {"method", point["method"]}};
  const auto cell = [](const Json& object, const std::string& key) {
    return object.contains(key) ? object.at(key) : Json(nullptr);
  };
  for (const std::string& pointer : pointers) row.emplace_back(pointer, cell(point["settings"], pointer));
  row.emplace_back("ended", point["ended"]);
  row.emplace_back("reason", point["reason"]);
  for (const std::string& key : cost_keys(results.study.measure.kind)) {
    for (const char* part : {"", "_low", "_high"}) row.emplace_back(key + part, cell(point["cost"], key + part));
  }
  for (const Quantity& quantity : results.study.quantities) {
    const auto is_among = [&](const Json& names) {
      return std::count(names.begin(), names.end(), Json(quantity.name)) > 0;
    };
    const Json distance = cell(point["errors"], quantity.name);
    const bool is_difference = is_among(point["differences"]);
    row.emplace_back(quantity.name, cell(point["values"], quantity.name));
    row.emplace_back("error of " + quantity.name, is_difference ? Json(nullptr) : distance);
    row.emplace_back("difference in " + quantity.name, is_difference ? distance : Json(nullptr));
    row.emplace_back("front of " + quantity.name, is_among(point["front"]) ? 1 : 0);
  }
  row.emplace_back("command", point["command"]);
  return row;
}

std::string percent_or_value(const Reference& reference, double error)
{
  return reference.relative ? fmt::format("{:.3g} %", error * 100) : fmt::format("{:.3g}", error);
}

/// The least and the greatest of what is no error.
std::string differences_text(const StudyResults& results, const QuantityFindings& found)
{
  std::vector<std::pair<double, std::string>> all;
  for (const int id : found.differences) {
    const Point& point = results.points[static_cast<std::size_t>(id) - 1].point;
    if (point.role == Point::Role::chart) all.emplace_back(found.errors.at(id), point.name());
  }
  if (all.empty()) return "";
  const auto [least, greatest] = std::minmax_element(all.begin(), all.end());
  return fmt::format("    differences from it, which are no errors, of {} to {}: {}; {}\n",
                     percent_or_value(found.reference, least->first),
                     percent_or_value(found.reference, greatest->first), least->second, greatest->second);
}

std::string front_text(const StudyResults& results, const Quantity& quantity, const QuantityFindings& found)
{
  const std::string key = cost_kinds(results.study.measure.kind).front().key;
  const std::string unit = cost_kinds(results.study.measure.kind).front().unit;
  std::string text;
  for (const int id : found.front) {
    const MeasuredPoint& one = results.points[static_cast<std::size_t>(id) - 1];
    text += fmt::format("    {:<10.4g} {} for an error of {}: {}, {}\n", one.result.cost(key)->median, unit,
                        percent_or_value(found.reference, found.errors.at(id)), one.point.method, one.point.label);
  }
  if (text.empty() && found.differences.empty()) return "    no errors of " + quantity.name + " are known\n";
  return text + differences_text(results, found);
}

std::string expectations_text(const StudyResults& results)
{
  if (results.expectations.empty()) return "";
  std::string text = "  expected:\n";
  for (const ExpectationResult& result : results.expectations) {
    text += fmt::format("    {}  {}: {}: {}, expected {}{}\n", verdict(result), result.quantity, result.label,
                        result.note, result.expected, result.why.empty() ? "" : " (" + result.why + ")");
  }
  return text;
}

}  // namespace

Json to_json(const StudyResults& results)
{
  const Study& study = results.study;
  return {{"name", study.file.stem().string()},
          {"title", study.title},
          {"about", study.about},
          {"takes", study.takes},
          {"command", results.command},
          {"program", version_text()},
          {"machine", machine_json()},
          {"threads", study.n_threads},
          {"repeat", study.repeat},
          {"costs", costs_json(study)},
          {"refine", refine_json(study)},
          {"methods", methods_json(results)},
          {"quantities", quantities_json(results)},
          {"points", points_json(results)},
          {"budgets", budgets_json(results)},
          {"gates", expectations_json(results)},
          {"map", map_to_json(results)}};
}

std::string to_csv(const StudyResults& results)
{
  const std::vector<std::string> pointers = pointers_of(results);
  std::vector<CsvRow> rows;
  for (const Json& point : points_json(results)) rows.push_back(row_of(results, point, pointers));
  return csv_text(rows);
}

std::string expectations_to_csv(const StudyResults& results)
{
  std::vector<CsvRow> rows;
  for (const Json& result : expectations_json(results)) {
    CsvRow& row = rows.emplace_back();
    for (const char* name : {"quantity", "label", "kind", "limit", "found", "holds", "note", "why"}) {
      row.emplace_back(name, result[name]);
    }
  }
  return csv_text(rows);
}

std::string to_text(const StudyResults& results)
{
  std::string text = results.study.title + "\n";
  for (std::size_t q = 0; q < results.study.quantities.size(); ++q) {
    const Quantity& quantity = results.study.quantities[q];
    const QuantityFindings& found = results.findings.quantities[q];
    text += fmt::format("  {}: {}", quantity.name, found.reference.note);
    if (found.reference.uncertainty && found.reference.kind != Reference::Kind::exact) {
      text += fmt::format("; reference known to {}", percent_or_value(found.reference, *found.reference.uncertainty));
    }
    text += "\n";
    const bool has_map = results.study.map && results.study.map->quantity == quantity.name;
    if (!has_map) text += front_text(results, quantity, found);
  }
  for (const ErrorBudget& budget : results.findings.budgets) {
    text += fmt::format("  error of {}, {}:\n", budget.quantity, budget.base);
    for (const BudgetAmount& part : budget.parts) {
      const std::string amount = part.amount ? fmt::format("{:.2g} %", *part.amount * 100) : "no bound";
      text += fmt::format("    {:<24} {:>9}  {}\n", part.name, amount, part.note);
    }
  }
  return text + map_to_text(results) + expectations_text(results);
}

}  // namespace tamp::tools::study
