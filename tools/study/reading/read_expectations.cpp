#include <fmt/format.h>

#include <algorithm>

#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

/// Reads the key that says what has to hold, one of several.
void read_bar(StudyReader& in, JsonReader& reader, Expectation& expected)
{
  using Kind = Expectation::Kind;
  const std::vector<std::pair<std::string, Kind>> kinds{
      {"order_at_least", Kind::order_at_least},           {"order_at_most", Kind::order_at_most},
      {"error_at_least", Kind::error_at_least},           {"error_at_most", Kind::error_at_most},
      {"limit_error_at_most", Kind::limit_error_at_most}, {"fails", Kind::fails}};
  const auto is_there = [&](const auto& kind) { return reader.has(kind.first); };
  if (std::count_if(kinds.begin(), kinds.end(), is_there) != 1) {
    reader.add_problem("quantity", fmt::format("\"{}\", of which not one thing is to hold", expected.quantity),
                       "expected one of order_at_least, order_at_most, error_at_least, error_at_most, "
                       "limit_error_at_most, fails");
    return;
  }
  const auto& [key, kind] = *std::find_if(kinds.begin(), kinds.end(), is_there);
  expected.kind = kind;
  const bool is_of_order = kind == Kind::order_at_least || kind == Kind::order_at_most;
  const bool is_of_limit = kind == Kind::limit_error_at_most;
  if ((is_of_order || is_of_limit) && in.study.refine.empty()) {
    reader.add_problem(key, fmt::format("{} in a study that refines nothing", is_of_order ? "an order" : "a limit"),
                       "expected the key refine");
  }
  if (is_of_limit && !in.has_exact_answer(expected.quantity)) {
    reader.add_problem(key, "the limit of a quantity without an exact answer", "expected one with the key exact");
  }
  if (kind != Kind::fails) {
    expected.limit = reader.number(key);
  } else if (!reader.flag(key)) {
    reader.add_problem(key, "false", "expected true, or another key: what has to hold is said");
  }
}

/// Reads the keys that go with some of these alone.
void read_terms(StudyReader& in, JsonReader& reader, Expectation& expected)
{
  using Kind = Expectation::Kind;
  const bool is_of_one = expected.kind == Kind::error_at_least || expected.kind == Kind::error_at_most;
  if (reader.has("at") && !(is_of_one && !in.study.refine.empty())) {
    reader.add_problem("at", "given where no error of one of several grids is judged",
                       "expected it beside error_at_least or error_at_most, in a study that refines something");
  }
  if (reader.has("limit_order") && expected.kind != Kind::limit_error_at_most) {
    reader.add_problem("limit_order", "given where no limit is judged", "expected it beside limit_error_at_most");
  }
  expected.at = reader.optional_number("at");
  expected.limit_order = reader.number("limit_order");
}

void read_misses(StudyReader& in, JsonReader& reader, Expectation& expected)
{
  const std::string key = "missed";
  if (!reader.has(key)) return;
  const Json& misses = in.document.root.at(reader.pointer(key));
  if (!misses.is_object()) {
    return reader.add_problem(key, misses.type_name(), "expected an object: method → why it misses");
  }
  for (const auto& [method, why] : misses.items()) {
    if (std::find(expected.methods.begin(), expected.methods.end(), method) == expected.methods.end()) {
      reader.add_problem(key, fmt::format("\"{}\"", method), "expected methods of which it is expected");
    }
    if (!why.is_string() || why.get<std::string>().empty()) {
      reader.add_problem(key, fmt::format("{} for \"{}\"", why.dump(), method), "expected why, in words");
    } else {
      expected.missed.emplace(method, why);
    }
  }
}

}  // namespace

void read_expectations(StudyReader& in)
{
  for (JsonReader& reader : in.root.objects("expect")) {
    Expectation expected;
    expected.quantity = reader.text("quantity", "");
    if (!in.find_quantity(expected.quantity)) {
      reader.add_problem("quantity", fmt::format("\"{}\"", expected.quantity), "expected the name of a quantity");
    }
    expected.methods = in.names(reader, "methods");
    for (const std::string& name : expected.methods) {
      if (in.find_method(name) != nullptr) continue;
      reader.add_problem("methods", fmt::format("\"{}\"", name), "expected names of methods");
    }
    if (!reader.has("methods")) {
      for (const Method& method : in.study.methods) expected.methods.push_back(method.name);
    }
    read_bar(in, reader, expected);
    read_terms(in, reader, expected);
    expected.why = reader.text("why", "");
    read_misses(in, reader, expected);
    reader.finish();
    in.study.expectations.push_back(std::move(expected));
  }
}

}  // namespace tamp::tools::study
