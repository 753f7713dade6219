#include "tools/study/gates.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "tools/study/richardson.hpp"

namespace tamp::tools::study
{

namespace
{

using Kind = Expectation::Kind;
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

  void judge(Gate& gate) const
  {
    gate.expected = expected(gate.kind, gate.limit);
    switch (gate.kind) {
      case Kind::order_at_least:
      case Kind::order_at_most:
        return judge_order(gate);
      case Kind::error_at_least:
      case Kind::error_at_most:
        return judge_error(gate);
      case Kind::fails:
        return judge_failure(gate);
    }
  }

 private:
  std::string as_text(double error) const
  {
    return found_.reference.relative ? fmt::format("{:.3g} %", error * 100) : fmt::format("{:.3g}", error);
  }

  std::string expected(Kind kind, double limit) const
  {
    switch (kind) {
      case Kind::order_at_least:
        return fmt::format("order at least {}", limit);
      case Kind::order_at_most:
        return fmt::format("order at most {}", limit);
      case Kind::error_at_least:
        return "error at least " + as_text(limit);
      case Kind::error_at_most:
        return "error at most " + as_text(limit);
      case Kind::fails:
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

  void judge_order(Gate& gate) const
  {
    std::vector<Json> values;
    std::vector<double> errors;
    for (const MeasuredPoint* one : group_) {
      if (!error(one)) {
        gate.note = "no order: " + lack(one);
        return;
      }
      values.push_back(one->point.setting(study_.refine));
      errors.push_back(*error(one));
    }
    constexpr std::size_t fewest = 3;
    const double order = fitted_order(spacings_of(values), errors, std::max(fewest, errors.size()));
    if (std::isnan(order)) {
      gate.note = "no order: fewer than three errors above 0";
      return;
    }
    gate.found = order;
    gate.note = fmt::format("order {:.2f}", order);
    gate.holds = gate.kind == Kind::order_at_least ? order >= gate.limit : order <= gate.limit;
  }

  void judge_error(Gate& gate) const
  {
    const MeasuredPoint* finest = group_.back();
    gate.found = error(finest);
    gate.note = gate.found ? "error " + as_text(*gate.found) : lack(finest);
    if (!gate.found) return;
    gate.holds = gate.kind == Kind::error_at_least ? *gate.found >= gate.limit : *gate.found <= gate.limit;
  }

  void judge_failure(Gate& gate) const
  {
    const auto is_unstable = [](const MeasuredPoint* one) { return one->result.end == End::unstable; };
    const auto unstable = std::find_if(group_.begin(), group_.end(), is_unstable);
    gate.found = error(group_.back());
    if (unstable != group_.end()) {
      gate.note = lack(*unstable);
      gate.holds = true;
      return;
    }
    const auto before = group_.size() > 1 ? error(group_[group_.size() - 2]) : std::nullopt;
    if (!gate.found) {
      gate.note = lack(group_.back());
    } else if (!before) {
      gate.note = "error " + as_text(*gate.found);
    } else {
      gate.holds = *gate.found > *before;
      gate.note = fmt::format("error {} from {} to {}", gate.holds ? "grows" : "does not grow", as_text(*before),
                              as_text(*gate.found));
    }
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

std::vector<Gate> gates_of(const Study& study, const std::vector<MeasuredPoint>& points, const Findings& findings)
{
  std::vector<Gate> gates;
  for (const Expectation& expected : study.expectations) {
    const auto is_its = [&](const Quantity& quantity) { return quantity.name == expected.quantity; };
    const auto at = std::find_if(study.quantities.begin(), study.quantities.end(), is_its);
    const auto& found = findings.quantities[static_cast<std::size_t>(at - study.quantities.begin())];
    for (const std::string& method : expected.methods) {
      for (const PointGroup& group : groups_of(study, points, method)) {
        Gate gate{expected.quantity, method, label_of(study, group), expected.kind, expected.limit};
        gate.why = expected.why;
        Judge(study, found, group).judge(gate);
        gates.push_back(std::move(gate));
      }
    }
  }
  return gates;
}

std::string to_text(Expectation::Kind kind)
{
  static constexpr std::array<const char*, 5> words{"order_at_least", "order_at_most", "error_at_least",
                                                    "error_at_most", "fails"};
  return words.at(static_cast<std::size_t>(kind));
}

}  // namespace tamp::tools::study
