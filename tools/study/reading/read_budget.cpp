#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

BudgetPart budget_part(StudyReader& in, JsonReader& reader)
{
  BudgetPart part;
  part.name = reader.text("name", "");
  part.to_reference = reader.flag("to_reference");
  for (const Json& one : in.list(reader, "set")) part.variations.push_back(in.settings_of(one, reader, "set"));
  if (part.to_reference == !part.variations.empty()) {
    reader.add_problem("set", part.to_reference ? "given beside to_reference" : "missing",
                       "expected either changes, or to_reference");
  }
  if (part.to_reference && !in.study.reference) {
    reader.add_problem("to_reference", "true", "expected a study with a reference");
  }
  if (part.to_reference && in.study.reference && in.study.reference->of_each_method) {
    reader.add_problem("to_reference", "true", "expected one reference for all methods");
  }
  reader.finish();
  return part;
}

}  // namespace

void read_budget(StudyReader& in)
{
  auto reader = in.root.optional_object("budget");
  if (!reader) return;
  Budget budget;
  for (const Json& name : in.list(*reader, "quantities")) {
    if (name.is_string() && in.find_quantity(name.get<std::string>())) {
      budget.quantities.push_back(name);
    } else {
      reader->add_problem("quantities", name.dump(), "expected names of quantities");
    }
  }
  for (JsonReader& base : reader->objects("of")) {
    budget.bases.push_back({base.text("name", ""), in.settings(base, "set")});
    base.finish();
  }
  for (JsonReader& part : reader->objects("parts")) budget.parts.push_back(budget_part(in, part));
  reader->finish();
  in.study.budget = std::move(budget);
}

}  // namespace tamp::tools::study
