#include <fmt/format.h>

#include <algorithm>

#include "tools/study/points.hpp"
#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

/// In floating point, which knows no overflow.
std::vector<std::pair<std::string, double>> n_points_by_key(StudyReader& in)
{
  std::vector<std::pair<std::string, double>> all;
  for (std::size_t i = 0; i < in.study.methods.size(); ++i) {
    const Method& method = in.study.methods[i];
    const std::string own = fmt::format("/methods/{}/sweep", i);
    double n = method.sweep.empty() && !method.listed.empty() ? 0 : 1;
    for (const Axis& axis : method.sweep) n *= static_cast<double>(axis.values.size());
    all.emplace_back(in.document.root.contains(JsonPointer(own)) ? own : "/sweep", n);
    all.emplace_back("/points", static_cast<double>(method.listed.size()));
  }
  if (in.study.reference) {
    const ReferenceRuns& reference = *in.study.reference;
    const std::size_t n = std::max<std::size_t>(reference.refinement.values.size(), 1) + reference.beside.size();
    const std::size_t n_references = reference.of_each_method ? in.study.methods.size() : 1;
    all.emplace_back("/reference", static_cast<double>(n) * static_cast<double>(n_references));
  }
  if (in.study.budget) {
    double n = 1;
    for (const BudgetPart& part : in.study.budget->parts) n += static_cast<double>(part.variations.size());
    all.emplace_back("/budget", n * static_cast<double>(in.study.budget->bases.size()));
  }
  return all;
}

}  // namespace

void read_measure(StudyReader& in)
{
  JsonReader reader = in.root.object("measure");
  using Kind = Measure::Kind;
  const std::vector<std::pair<std::string, Kind>> kinds{
      {"run", Kind::run}, {"drive", Kind::drive}, {"modulus", Kind::modulus}};
  const auto is_there = [&](const auto& kind) { return reader.has(kind.first); };
  if (std::count_if(kinds.begin(), kinds.end(), is_there) != 1) {
    in.root.add_problem("measure", "not one thing to measure", "expected one of run, drive, modulus");
    return;
  }
  const auto& [key, kind_of_key] = *std::find_if(kinds.begin(), kinds.end(), is_there);
  const Kind kind = in.study.measure.kind = kind_of_key;
  in.study.measure.file = in.from_here(reader.existing_file(key));
  if (kind == Kind::drive) in.study.measure.along = in.from_here(reader.existing_file("path"));
  if (kind == Kind::drive) in.study.measure.increment = reader.number("increment");
  if (kind == Kind::modulus) in.study.measure.along = in.from_here(reader.existing_file("states"));
  const auto is_needed = [&](const char* name) {
    return (name == std::string("path") && kind == Kind::drive) ||
           (name == std::string("states") && kind == Kind::modulus);
  };
  for (const char* name : {"path", "states"}) {
    if (reader.has(name) && !is_needed(name)) reader.add_problem(name, "given beside " + key, "expected no such key");
  }
  reader.finish();
}

void read_methods(StudyReader& in)
{
  const std::vector<Axis> sweep = in.axes(in.root, "sweep");
  for (JsonReader& reader : in.root.objects("methods")) {
    Method method;
    method.name = reader.text("name", "");
    if (method.name.empty()) reader.add_problem("name", "no name", "expected a text");
    if (method.name == reference_name || method.name == budget_name || in.find_method(method.name) != nullptr) {
      reader.add_problem("name", fmt::format("\"{}\", which is taken", method.name), "expected another name");
    }
    method.family = reader.text("family", method.name);
    method.dashed = reader.flag("dashed");
    method.another_model = reader.flag("another_model");
    method.settings = in.settings(reader, "set");
    method.sweep = reader.has("sweep") ? in.axes(reader, "sweep") : sweep;
    reader.finish();
    in.study.methods.push_back(std::move(method));
  }
  if (in.study.methods.empty()) in.root.add_problem("methods", "no method", "expected one at least");
}

void read_points(StudyReader& in)
{
  for (JsonReader& reader : in.root.objects("points")) {
    const std::string name = reader.text("method", "");
    Method* method = in.find_method(name);
    if (method == nullptr) {
      reader.add_problem("method", fmt::format("\"{}\"", name), "expected the name of a method");
    } else {
      method->listed.push_back(in.settings(reader, "set"));
    }
    reader.finish();
  }
}

/// Counted before they are made, and reported where most of them come from.
void expect_few_points(StudyReader& in)
{
  const auto all = n_points_by_key(in);
  const auto is_less = [](const auto& a, const auto& b) { return a.second < b.second; };
  const auto most = std::max_element(all.begin(), all.end(), is_less);
  double n = 0;
  for (const auto& [key, points] : all) n += points;
  if (n <= most_points) return;
  in.document.add_problem(JsonPointer(most->first), n < 1e15 ? fmt::format("{:.0f} points", n) : "over 1e15 points",
                          fmt::format("expected at most {:.0f}", most_points));
}

}  // namespace tamp::tools::study
