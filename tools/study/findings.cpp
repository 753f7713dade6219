#include "tools/study/findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/study/richardson.hpp"

namespace tamp::tools::study
{

namespace
{

double first_cost(const Study& study, const MeasuredPoint& point)
{
  const auto cost = point.result.cost(cost_kinds(study.measure.kind).front().key);
  return cost ? cost->median : INFINITY;
}

/// Points of the charts for which there is an error, cheapest first, of those that are cheaper each better than all.
std::vector<int> pareto_front(const Study& study, const std::vector<MeasuredPoint>& points,
                              const QuantityFindings& found)
{
  const std::map<int, double>& errors = found.errors;
  std::vector<const MeasuredPoint*> in_order;
  for (const MeasuredPoint& one : points) {
    const bool has_error = errors.contains(one.point.id) && !found.differences.contains(one.point.id);
    if (one.point.role == Point::Role::chart && has_error) in_order.push_back(&one);
  }
  const auto rank = [&](const MeasuredPoint* one) {
    return std::pair(first_cost(study, *one), errors.at(one->point.id));
  };
  std::sort(in_order.begin(), in_order.end(), [&](const auto* a, const auto* b) { return rank(a) < rank(b); });
  std::vector<int> front;
  double best = INFINITY;
  for (const MeasuredPoint* one : in_order) {
    if (errors.at(one->point.id) >= best) continue;
    best = errors.at(one->point.id);
    front.push_back(one->point.id);
  }
  return front;
}

Settings without(Settings settings, const std::string& pointer)
{
  std::erase_if(settings, [&](const auto& setting) { return setting.first == pointer; });
  return settings;
}

/// Larger values are coarser, unless the reference's rise.
void sort_from_coarse_to_fine(const Study& study, std::vector<const MeasuredPoint*>& group)
{
  const bool rises = study.reference && study.reference->refinement.pointer == study.refine &&
                     study.reference->refinement.values.front() < study.reference->refinement.values.back();
  const auto spacing = [&](const MeasuredPoint* one) {
    const double value = one->point.setting(study.refine).get<double>();
    return rises ? -value : value;
  };
  std::stable_sort(group.begin(), group.end(), [&](const auto* a, const auto* b) { return spacing(a) > spacing(b); });
}

OrderFit order_fit(const Study& study, std::vector<const MeasuredPoint*> group, const QuantityFindings& found)
{
  const Point& first = group.front()->point;
  const std::string others = settings_text(without(first.own, study.refine));
  OrderFit fit{first.method, first.method + (others.empty() ? "" : ", " + others), {}, std::nullopt, std::nullopt, ""};
  std::vector<Json> values;
  std::vector<double> of_points, costs;
  for (const MeasuredPoint* one : group) {
    const auto error = found.errors.find(one->point.id);
    if (error == found.errors.end()) continue;
    fit.points.push_back(one->point.id);
    values.push_back(one->point.setting(study.refine));
    of_points.push_back(error->second);
    costs.push_back(first_cost(study, *one));
  }
  const double power = fitted_order(spacings_of(values), costs, 2);
  if (std::isfinite(power)) fit.cost_power = power;
  const double order = fitted_order(spacings_of(values), of_points);
  const auto is_difference = [&](int id) { return found.differences.contains(id); };
  if (std::any_of(fit.points.begin(), fit.points.end(), is_difference)) {
    fit.note = "no order: differences, which are no errors";
  } else if (std::isnan(order)) {
    fit.note = "no order: fewer than three errors above 0";
  } else if (!std::is_sorted(of_points.rbegin(), of_points.rend())) {
    fit.note = "no order: errors do not fall from each to the next";
  } else {
    fit.order = order;
  }
  return fit;
}

/// The answer that each method is compared with.
class References
{
 public:
  References(const Study& study, const Quantity& quantity, const std::vector<MeasuredPoint>& points)
  {
    if (!study.reference || !study.reference->of_each_method) {
      common_ = reference_of(study, quantity, points);
      return;
    }
    for (const Method& method : study.methods) own_[method.name] = reference_of(study, quantity, points, method.name);
    sum_up();
  }

  /// The reference of all points, or the least certain of those of the methods.
  const Reference& common() const { return common_; }

  /// The reference of a point; none for a variation of an error budget where each method has its own.
  const Reference& of(const Point& point) const
  {
    static const Reference none;
    if (!own_.empty() && point.role == Point::Role::variation) return none;
    const auto own = own_.find(point.reference_of.empty() ? point.method : point.reference_of);
    return own == own_.end() ? common_ : own->second;
  }

 private:
  void sum_up()
  {
    const auto less_certain = [](const auto& a, const auto& b) {
      const Reference &first = a.second, &second = b.second;
      if (first.bound != second.bound) return first.bound;
      return first.uncertainty.value_or(0) < second.uncertainty.value_or(0);
    };
    const auto& [method, reference] = *std::max_element(own_.begin(), own_.end(), less_certain);
    common_ = reference;
    common_.note = fmt::format("of each method its own, least certain that of {}: {}", method, reference.note);
  }

  Reference common_;
  std::map<std::string, Reference> own_;
};

bool models_something_else(const Study& study, const Point& point)
{
  return std::any_of(study.methods.begin(), study.methods.end(),
                     [&](const Method& method) { return method.name == point.method && method.another_model; });
}

/// A run that is the reference itself, by whatever name, has no error that is known.
bool is_itself(const Reference& reference, const MeasuredPoint& one, const std::vector<MeasuredPoint>& points)
{
  if (reference.kind != Reference::Kind::run && reference.kind != Reference::Kind::finest) return false;
  return one.result.folder == points[static_cast<std::size_t>(reference.point) - 1].result.folder;
}

QuantityFindings findings_of_one(const Study& study, const Quantity& quantity, const std::vector<MeasuredPoint>& points)
{
  QuantityFindings found;
  const References references(study, quantity, points);
  found.reference = references.common();
  for (const MeasuredPoint& one : points) {
    if (!one.done()) continue;
    const Answer answer = answer_of(study, quantity, one.result);
    if (!std::isfinite(answer.value)) continue;
    if (!quantity.is_column()) found.values[one.point.id] = answer.value;
    const Reference& reference = references.of(one.point);
    const auto error = reference.error(quantity, answer);
    if (!error || !std::isfinite(*error) || is_itself(reference, one, points)) continue;
    found.errors[one.point.id] = *error;
    if (!reference.bound || (!quantity.exact && models_something_else(study, one.point))) {
      found.differences.insert(one.point.id);
    }
  }
  found.front = pareto_front(study, points, found);
  if (!study.refine.empty()) {
    for (const auto& group : refined_groups(study, points)) {
      if (group.size() > 1) found.orders.push_back(order_fit(study, group, found));
    }
  }
  return found;
}

}  // namespace

std::vector<std::vector<const MeasuredPoint*>> refined_groups(const Study& study,
                                                              const std::vector<MeasuredPoint>& points)
{
  std::vector<std::vector<const MeasuredPoint*>> groups;
  for (const MeasuredPoint& one : points) {
    if (one.point.role == Point::Role::variation || !one.point.setting(study.refine).is_number()) continue;
    if (!one.point.reference_of.empty()) continue;
    const auto is_of = [&](const std::vector<const MeasuredPoint*>& group) {
      return group.front()->point.method == one.point.method &&
             without(group.front()->point.settings, study.refine) == without(one.point.settings, study.refine);
    };
    const auto group = std::find_if(groups.begin(), groups.end(), is_of);
    if (group == groups.end()) {
      groups.push_back({&one});
    } else {
      group->push_back(&one);
    }
  }
  for (auto& group : groups) sort_from_coarse_to_fine(study, group);
  return groups;
}

Findings findings_of(const Study& study, const std::vector<MeasuredPoint>& points)
{
  Findings findings;
  for (const Quantity& quantity : study.quantities) {
    findings.quantities.push_back(findings_of_one(study, quantity, points));
    if (!study.budget) continue;
    const std::vector<std::string>& asked = study.budget->quantities;
    if (std::find(asked.begin(), asked.end(), quantity.name) == asked.end()) continue;
    for (const BudgetBase& base : study.budget->bases) {
      findings.budgets.push_back(error_budget(study, base, quantity, findings.quantities.back().reference, points));
    }
  }
  return findings;
}

}  // namespace tamp::tools::study
