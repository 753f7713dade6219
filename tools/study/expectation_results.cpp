#include "tools/study/expectation_results.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>

#include "tools/study/richardson.hpp"

namespace tamp::tools::study
{

namespace
{

using Bar = Expectation::Kind;
using PointGroup = std::vector<const MeasuredPoint*>;

/// Points of a method that are judged together: those that were refined, from coarse to fine, or each by itself.
std::vector<PointGroup> groups_of(const Study& study, const std::vector<MeasuredPoint>& points,
                                  const std::string& method)
{
  std::vector<PointGroup> groups;
  if (study.refine.empty()) {
    for (const MeasuredPoint& one : points) groups.push_back({&one});
  } else {
    groups = refined_groups(study, points);
  }
  std::erase_if(groups, [&](const PointGroup& group) { return group.front()->point.method != method; });
  return groups;
}

/// Judges one group of points by the errors of one quantity.
class Judge
{
 public:
  Judge(const Study& study, const QuantityFindings& found, const PointGroup& group)
      : study_(study), found_(found), group_(group)
  {
  }

  void judge(const Expectation& expectation, ExpectationResult& result) const
  {
    result.expected = expected(expectation);
    switch (result.kind) {
      case Bar::order_at_least:
      case Bar::order_at_most:
        return judge_order(result);
      case Bar::error_at_least:
      case Bar::error_at_most:
        return judge_error(expectation.at, result);
      case Bar::limit_error_at_most:
        return judge_limit(expectation.limit_order, result);
      case Bar::fails:
        return judge_failure(result);
    }
  }

 private:
  std::string as_text(double error) const
  {
    return found_.reference.relative ? fmt::format("{:.3g} %", error * 100) : fmt::format("{:.3g}", error);
  }

  std::string expected(const Expectation& expectation) const
  {
    const double limit = expectation.limit;
    const std::string at = expectation.at ? fmt::format(" at {}", *expectation.at) : std::string();
    switch (expectation.kind) {
      case Bar::order_at_least:
        return fmt::format("order at least {}", limit);
      case Bar::order_at_most:
        return fmt::format("order at most {}", limit);
      case Bar::error_at_least:
        return "error at least " + as_text(limit) + at;
      case Bar::error_at_most:
        return "error at most " + as_text(limit) + at;
      case Bar::limit_error_at_most:
        return fmt::format("error of the limit by order {} at most {}", expectation.limit_order, as_text(limit));
      case Bar::fails:
        return "fails";
    }
    return "";
  }

  std::optional<double> error(const MeasuredPoint* one) const
  {
    const auto at = found_.errors.find(one->point.id);
    return at == found_.errors.end() ? std::nullopt : std::optional(at->second);
  }

  /// Why a point has no error.
  std::string lack(const MeasuredPoint* one) const
  {
    const std::string reason = one->done() ? "no error is known" : one->result.reason;
    return fmt::format("{}: {}: {}", one->point.label, to_text(one->result.end), reason);
  }

  /// The first point without an error, or null.
  const MeasuredPoint* failed_point() const
  {
    const auto at = std::find_if(group_.begin(), group_.end(), [&](const MeasuredPoint* one) { return !error(one); });
    return at == group_.end() ? nullptr : *at;
  }

  std::vector<double> spacings() const
  {
    std::vector<Json> values;
    for (const MeasuredPoint* one : group_) values.push_back(one->point.setting(study_.refine));
    return spacings_of(values);
  }

  void judge_order(ExpectationResult& result) const
  {
    if (const MeasuredPoint* failed = failed_point()) {
      result.note = "no order: " + lack(failed);
      return;
    }
    std::vector<double> errors;
    for (const MeasuredPoint* one : group_) errors.push_back(*error(one));
    constexpr std::size_t fewest = 3;
    const double order = fitted_order(spacings(), errors, std::max(fewest, errors.size()));
    if (std::isnan(order)) {
      result.note = "no order: fewer than three errors above 0";
      return;
    }
    result.found = order;
    result.note = fmt::format("order {:.2f}", order);
    result.holds = result.kind == Bar::order_at_least ? order >= result.limit : order <= result.limit;
  }

  /// On the finest grid, or where the refined setting has the value `at`.
  void judge_error(const std::optional<double>& at, ExpectationResult& result) const
  {
    const auto is_there = [&](const MeasuredPoint* one) { return one->point.setting(study_.refine) == *at; };
    const auto one = at ? std::find_if(group_.begin(), group_.end(), is_there) : std::prev(group_.end());
    if (one == group_.end()) {
      result.note = "no point there";
      return;
    }
    result.found = error(*one);
    result.note = result.found ? "error " + as_text(*result.found) : lack(*one);
    if (!result.found) return;
    result.holds = result.kind == Bar::error_at_least ? *result.found >= result.limit : *result.found <= result.limit;
  }

  void judge_limit(double order, ExpectationResult& result) const
  {
    if (const MeasuredPoint* failed = failed_point()) {
      result.note = "no limit: " + lack(failed);
      return;
    }
    std::vector<double> answers;
    for (const MeasuredPoint* one : group_) answers.push_back(found_.values.at(one->point.id));
    const double limit = fitted_limit(spacings(), answers, order);
    if (std::isnan(limit)) {
      result.note = "no limit: fewer than three grids";
      return;
    }
    result.found = std::abs(limit - found_.reference.answer.value) / found_.reference.scale;
    result.note = "error of the limit " + as_text(*result.found);
    result.holds = *result.found <= result.limit;
  }

  void judge_failure(ExpectationResult& result) const
  {
    const auto is_unstable = [](const MeasuredPoint* one) { return one->result.end == End::unstable; };
    const auto unstable = std::find_if(group_.begin(), group_.end(), is_unstable);
    result.found = error(group_.back());
    if (unstable != group_.end()) {
      result.note = lack(*unstable);
      result.holds = true;
      return;
    }
    if (const MeasuredPoint* failed = failed_point()) {
      result.note = lack(failed);
      return;
    }
    // Less may be what is left of a method that has converged to its floor.
    constexpr double growth = 1.5;
    double least = *result.found;
    for (const MeasuredPoint* one : group_) least = std::min(least, *error(one));
    result.holds = *result.found >= growth * least;
    result.note = fmt::format("error on the finest grid {}, at least {}", as_text(*result.found), as_text(least));
  }

  const Study& study_;
  const QuantityFindings& found_;
  const PointGroup& group_;
};

std::string label_of(const Study& study, const PointGroup& group)
{
  const Point& point = group.front()->point;
  Settings others = point.own;
  std::erase_if(others, [&](const auto& setting) { return setting.first == study.refine; });
  return others.empty() ? point.method : point.method + ", " + settings_text(others);
}

}  // namespace

std::vector<ExpectationResult> judge_expectations(const Study& study, const std::vector<MeasuredPoint>& points,
                                                  const Findings& findings)
{
  std::vector<ExpectationResult> results;
  for (const Expectation& expected : study.expectations) {
    const auto is_its = [&](const Quantity& quantity) { return quantity.name == expected.quantity; };
    const auto at = std::find_if(study.quantities.begin(), study.quantities.end(), is_its);
    const auto& found = findings.quantities[static_cast<std::size_t>(at - study.quantities.begin())];
    for (const std::string& method : expected.methods) {
      for (const PointGroup& group : groups_of(study, points, method)) {
        ExpectationResult result{expected.quantity, method, label_of(study, group), expected.kind, expected.limit};
        result.why = expected.why;
        const auto miss = expected.missed.find(method);
        if (miss != expected.missed.end()) result.missed = miss->second;
        Judge(study, found, group).judge(expected, result);
        results.push_back(std::move(result));
      }
    }
  }
  return results;
}

std::string verdict(const ExpectationResult& result)
{
  if (result.missed.empty()) return result.holds ? "holds" : "FAILS";
  return result.holds ? "holds, though known to be missed" : "missed, as known";
}

std::string to_text(Expectation::Kind kind)
{
  static constexpr std::array<const char*, 6> words{"order_at_least", "order_at_most",       "error_at_least",
                                                    "error_at_most",  "limit_error_at_most", "fails"};
  return words.at(static_cast<std::size_t>(kind));
}

}  // namespace tamp::tools::study
