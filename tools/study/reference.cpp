#include "tools/study/reference.hpp"

#include <fmt/format.h>

#include <cmath>

#include "tools/study/richardson.hpp"

namespace tamp::tools::study
{

namespace
{

/// The same factor of safety as in the grid convergence index of three grids (Roache 1994).
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
  reference.relative = magnitude > 0 || (quantity.scale && *quantity.scale != 1);
}

/// What the answers on finer and finer grids tend to.
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
  std::vector<Answer> answers;
  Reference reference;
  for (const MeasuredPoint& one : points) {
    if (one.point.role != Point::Role::reference || one.point.reference_of != method) continue;
    if (!one.done()) {
      reference.note = fmt::format("no reference: {} ended with {}: {}", one.point.label, to_text(one.result.end),
                                   one.result.reason);
      return reference;
    }
    answers.push_back(answer_of(study, quantity, one.result));
    reference.point = one.point.id;
  }
  if (answers.empty()) {
    reference.note = "no reference was asked for";
    return reference;
  }
  const int last = reference.point;
  if (answers.size() > 1) {
    reference = limit_reference(quantity, spacings_of(study.reference->refinement.values), answers);
  } else {
    reference.kind = Reference::Kind::run;
    reference.answer = answers.front();
    reference.note = "one run, taken as it is: how far it is off itself is not known";
    scale_errors(quantity, reference);
  }
  reference.point = last;
  return reference;
}

std::vector<double> spacings_of(const std::vector<Json>& values)
{
  std::vector<double> spacings;
  for (const Json& value : values) spacings.push_back(value.get<double>());
  if (spacings.size() > 1 && spacings.front() < spacings.back()) {
    for (double& spacing : spacings) spacing = 1 / spacing;
  }
  return spacings;
}

}  // namespace tamp::tools::study
