#include "tools/study/reference.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "tools/study/richardson.hpp"

namespace tamp::tools::study
{

namespace
{

/// Factor of safety of the grid convergence index of three grids (Roache 1994).
constexpr double safety = 1.25;

Reference exact_reference(const Quantity& quantity)
{
  Reference reference;
  reference.kind = Reference::Kind::exact;
  reference.answer.value = *quantity.exact;
  reference.uncertainty = 0;
  reference.bound = true;
  reference.note = "exact";
  return reference;
}

void scale_errors(const Quantity& quantity, Reference& reference)
{
  if (quantity.is_column()) return;
  const double magnitude = std::abs(reference.answer.value);
  reference.scale = quantity.scale.value_or(magnitude > 0 ? magnitude : 1);
  reference.relative = magnitude > 0 || quantity.scale;
}

/// Limit of the answers on finer and finer grids.
Reference limit_reference(const Quantity& quantity, const std::vector<double>& spacings,
                          const std::vector<Answer>& answers)
{
  std::vector<double> differences;
  for (std::size_t i = 1; i < answers.size(); ++i) {
    differences.push_back(distance(quantity, answers[i - 1], answers[i]));
  }
  const Convergence found = convergence(spacings, differences);
  Reference reference;
  reference.kind = Reference::Kind::finest;
  reference.answer = answers.back();
  reference.bound = found.falls;
  reference.note = found.note;
  if (found.falls && !quantity.is_column()) {
    reference.kind = Reference::Kind::extrapolated;
    reference.answer.value += found.rest;
  }
  scale_errors(quantity, reference);
  if (found.falls) {
    reference.order = found.order;
    reference.uncertainty = safety * std::abs(found.rest) / reference.scale;
  }
  return reference;
}

Reference run_reference(const Quantity& quantity, const Answer& answer)
{
  Reference reference;
  reference.kind = Reference::Kind::run;
  reference.answer = answer;
  reference.note = "one run, taken as it is: how far it is off itself is not known";
  scale_errors(quantity, reference);
  return reference;
}

std::vector<const MeasuredPoint*> runs_of(const std::vector<MeasuredPoint>& points, Point::Role role,
                                          const std::string& method)
{
  std::vector<const MeasuredPoint*> runs;
  for (const MeasuredPoint& one : points) {
    if (one.point.role == role && one.point.reference_of == method) runs.push_back(&one);
  }
  return runs;
}

/// Why the runs are no reference; empty where they are.
std::string problem_of(const std::vector<const MeasuredPoint*>& runs)
{
  for (const MeasuredPoint* run : runs) {
    if (run->done()) continue;
    return fmt::format("no reference: {} ended with {}: {}", run->point.run_name(), to_text(run->result.end),
                       run->result.reason);
  }
  return "";
}

/// The form that is missing might be the one that does not agree.
void claim_nothing(const MeasuredPoint& form, Reference& reference)
{
  reference.note =
      fmt::format("no bound: {}, beside it, ended with {}", form.point.run_name(), to_text(form.result.end));
  reference.bound = false;
  reference.uncertainty.reset();
}

/// The reference is known no better than forms with as good a claim agree with it.
void compare_with_other_forms(const Study& study, const Quantity& quantity,
                              const std::vector<const MeasuredPoint*>& forms, Reference& reference)
{
  double furthest = 0;
  std::string label;
  for (const MeasuredPoint* form : forms) {
    if (!form->done()) return claim_nothing(*form, reference);
    const double apart = *reference.error(quantity, answer_of(study, quantity, form->result));
    if (apart > furthest) label = form->point.label;
    furthest = std::max(furthest, apart);
  }
  if (label.empty()) return;
  reference.note += fmt::format("; other forms are up to {:.2g} {} from it ({})",
                                reference.relative ? furthest * 100 : furthest, reference.relative ? "%" : "", label);
  if (reference.uncertainty) reference.uncertainty = std::max(*reference.uncertainty, furthest);
}

}  // namespace

std::optional<double> Reference::error(const Quantity& quantity, const Answer& other) const
{
  if (kind == Kind::none) return std::nullopt;
  return std::abs(distance(quantity, answer, other)) / scale;
}

Reference reference_of(const Study& study, const Quantity& quantity, const std::vector<MeasuredPoint>& points,
                       const std::string& method)
{
  if (quantity.exact) {
    Reference reference = exact_reference(quantity);
    scale_errors(quantity, reference);
    return reference;
  }
  const auto runs = runs_of(points, Point::Role::reference, method);
  Reference reference;
  reference.note = runs.empty() ? "no reference was asked for" : problem_of(runs);
  if (!reference.note.empty()) return reference;
  std::vector<Answer> answers;
  answers.reserve(runs.size());
  for (const MeasuredPoint* run : runs) answers.push_back(answer_of(study, quantity, run->result));
  reference = answers.size() > 1 ? limit_reference(quantity, spacings_of(study.reference->refinement.values), answers)
                                 : run_reference(quantity, answers.front());
  reference.point = runs.back()->point.id;
  compare_with_other_forms(study, quantity, runs_of(points, Point::Role::witness, method), reference);
  return reference;
}

std::vector<double> spacings_of(const std::vector<Json>& values)
{
  std::vector<double> spacings;
  spacings.reserve(values.size());
  for (const Json& value : values) spacings.push_back(value.get<double>());
  if (spacings.size() > 1 && spacings.front() < spacings.back()) {
    for (double& spacing : spacings) spacing = 1 / spacing;
  }
  return spacings;
}

}  // namespace tamp::tools::study
