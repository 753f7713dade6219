#include <fmt/format.h>

#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

/// A number of the summary is there already.
void refuse_places(JsonReader& reader)
{
  for (const char* key : {"take", "column", "plus", "at", "field", "component", "material", "line", "quantile"}) {
    if (reader.has(key)) reader.add_problem(key, "given beside summary", "expected one or the other");
  }
}

/// A number at the origin, and one for each axis of a scene.
std::vector<double> line(StudyReader& in, JsonReader& reader)
{
  std::vector<double> numbers;
  for (const Json& number : in.list(reader, "line")) {
    if (number.is_number()) numbers.push_back(number);
  }
  if (numbers.size() < 3 || numbers.size() > 4 || numbers.size() != in.list(reader, "line").size()) {
    reader.add_problem("line", reader.has("line") ? "not that" : "missing",
                       "expected a list of 3 or 4 numbers: at the origin, and for each metre along each axis");
  }
  return numbers;
}

void read_place(StudyReader& in, JsonReader& reader, Quantity& quantity)
{
  if (!quantity.is_of_field()) {
    quantity.column = reader.text("column", "");
    if (quantity.column.empty()) reader.add_problem("column", "missing", "expected the name of a column");
    if (quantity.take == Take::value || quantity.take == Take::mean) quantity.time = reader.number("at");
    quantity.plus = in.names(reader, "plus");
    return;
  }
  quantity.field = reader.text("field", "");
  quantity.material = reader.text("material", "");
  if (reader.has("component")) quantity.component = reader.whole_number("component");
  if (quantity.take == Take::quantile) quantity.quantile = reader.number("quantile");
  if (quantity.take == Take::field_rms) quantity.line = line(in, reader);
  if (quantity.field.empty()) reader.add_problem("field", "missing", "expected a field of the particles");
  if (quantity.material.empty()) reader.add_problem("material", "missing", "expected the name of a material");
  if (in.study.measure.kind != Measure::Kind::run) {
    reader.add_problem("take", "what is taken of a field", "expected it in studies of runs only");
  }
}

}  // namespace

void read_quantities(StudyReader& in)
{
  for (JsonReader& reader : in.root.objects("quantities")) {
    Quantity quantity;
    quantity.name = reader.text("name", "");
    if (quantity.name.empty() || in.find_quantity(quantity.name)) {
      reader.add_problem("name", quantity.name.empty() ? "no name" : "a name that is taken",
                         "expected a name of its own");
    }
    quantity.summary = in.pointer(reader, "summary");
    if (quantity.is_of_summary()) {
      refuse_places(reader);
    } else {
      quantity.take = reader.choice<Take>("take");
      read_place(in, reader, quantity);
    }
    quantity.exact = reader.optional_number("exact");
    quantity.scale = reader.optional_number("scale");
    reader.finish();
    in.study.quantities.push_back(std::move(quantity));
  }
  if (in.study.quantities.empty()) {
    in.root.add_problem("quantities", "no quantity", "expected one at least: a column, and how it is taken");
  }
}

/// Columns mean something only beside another.
void expect_answers(StudyReader& in)
{
  for (const Quantity& quantity : in.study.quantities) {
    if (quantity.is_column() && !in.study.reference) {
      in.root.add_problem("quantities", fmt::format("\"{}\", a column, without a reference", quantity.name),
                          "expected a reference to compare it with");
    }
    if (quantity.take == Take::farthest && !quantity.exact) {
      in.root.add_problem("quantities", fmt::format("\"{}\", the value farthest from no number", quantity.name),
                          "expected the exact answer");
    }
    if (quantity.is_column() && quantity.exact) {
      in.root.add_problem("quantities", fmt::format("\"{}\", a column, with an exact number", quantity.name),
                          "expected a number that is taken of it");
    }
  }
}

}  // namespace tamp::tools::study
