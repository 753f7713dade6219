#include <fmt/format.h>

#include <algorithm>

#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

constexpr std::size_t fewest_grids = 3;

/// Numbers above 0 that fall or rise.
bool are_spacings(const std::vector<Json>& values)
{
  const auto is_bad = [](const Json& value) { return !value.is_number() || value.get<double>() <= 0; };
  if (std::any_of(values.begin(), values.end(), is_bad)) return false;
  const auto rises = [](const Json& a, const Json& b) { return a.get<double>() < b.get<double>(); };
  const auto falls = [](const Json& a, const Json& b) { return a.get<double>() > b.get<double>(); };
  const auto all_are = [&](auto in_order) {
    return std::adjacent_find(values.begin(), values.end(),
                              [&](const Json& a, const Json& b) { return !in_order(a, b); }) == values.end();
  };
  return all_are(rises) || all_are(falls);
}

}  // namespace

void read_reference(StudyReader& in)
{
  auto reader = in.root.optional_object("reference");
  if (!reader) return;
  ReferenceRuns reference;
  reference.settings = in.settings(*reader, "set");
  reference.refinement.pointer = in.pointer(*reader, "refine");
  reference.refinement.values = in.list(*reader, "values");
  reference.of_each_method = reader->flag("of_each_method");
  for (const Json& one : in.list(*reader, "beside")) reference.beside.push_back(in.settings_of(one, *reader, "beside"));
  if (!reference.refinement.pointer.empty() && reference.refinement.values.size() < fewest_grids) {
    reader->add_problem("values", fmt::format("{} values", reference.refinement.values.size()),
                        fmt::format("expected {} at least, from coarse to fine: an order takes as many", fewest_grids));
  }
  if (!are_spacings(reference.refinement.values)) {
    reader->add_problem("values", "values that are no spacings",
                        "expected numbers above 0, each less than the one before, or each greater");
  }
  if (reference.refinement.pointer.empty() && !reference.refinement.values.empty()) {
    reader->add_problem("refine", "missing", "expected the JSON pointer whose values are given");
  }
  reader->finish();
  in.study.reference = std::move(reference);
}

}  // namespace tamp::tools::study
