#include <fmt/format.h>

#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

/// Reads the name of a method, which must have a single point, as one number is judged.
std::string method_with_one_point(StudyReader& in, JsonReader& reader, const std::string& key)
{
  std::string name = in.needed_text(reader, key);
  if (name.empty()) return name;
  const Method* method = in.find_method(name);
  if (method == nullptr) {
    reader.add_problem(key, fmt::format("\"{}\"", name), "expected the name of a method");
  } else if (!method->sweep.empty() || method->listed.size() > 1) {
    reader.add_problem(key, fmt::format("\"{}\", of several points", name), "expected a method with one");
  }
  return name;
}

}  // namespace

void read_stability(StudyReader& in)
{
  auto reader = in.root.optional_object("stability");
  if (!reader) return;
  Stability stability;
  stability.quantity = in.needed_text(*reader, "quantity");
  stability.threshold = reader->number("threshold");
  stability.fails = method_with_one_point(in, *reader, "fails");
  stability.survives = method_with_one_point(in, *reader, "survives");
  stability.symptom = in.needed_text(*reader, "symptom");
  stability.monitor = in.needed_text(*reader, "monitor");
  if (!stability.quantity.empty() && !in.has_error(stability.quantity)) {
    reader->add_problem("quantity", fmt::format("\"{}\"", stability.quantity),
                        "expected the name of a quantity with an exact answer, or of a study with a reference");
  }
  if (!stability.fails.empty() && stability.fails == stability.survives) {
    reader->add_problem("survives", fmt::format("\"{}\", which fails", stability.survives), "expected another method");
  }
  reader->finish();
  in.study.stability = std::move(stability);
}

void read_stable_if(StudyReader& in)
{
  auto reader = in.root.optional_object("stable_if");
  if (!reader) return;
  StableIf& stable = in.study.stable_if;
  stable.energy_error = reader->optional_number("energy_error_at_most");
  stable.quantity = reader->text("quantity", "");
  stable.error = reader->optional_number("error_at_most");
  if (!stable.quantity.empty() && !in.has_exact_answer(stable.quantity)) {
    reader->add_problem("quantity", fmt::format("\"{}\"", stable.quantity),
                        "expected the name of a quantity with an exact answer");
  }
  if (stable.quantity.empty() == stable.error.has_value()) {
    reader->add_problem("error_at_most", stable.error ? "given without a quantity" : "missing",
                        "expected both quantity and error_at_most, or neither");
  }
  reader->finish();
}

}  // namespace tamp::tools::study
