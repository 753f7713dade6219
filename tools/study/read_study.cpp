#include "tools/study/reading/parts.hpp"

namespace tamp::tools::study
{

namespace
{

void read_head(StudyReader& in)
{
  in.study.file = in.document.file();
  in.study.title = in.root.text("title", in.document.file().stem().string());
  in.study.about = in.root.text("about", "");
  in.study.takes = in.root.text("takes", "");
}

void read_limits(StudyReader& in)
{
  in.study.repeat = in.root.whole_number("repeat");
  in.study.repeat_below = in.root.number("repeat_below_s");
  in.study.limit = in.root.optional_number("limit_s").value_or(in.study.limit);
  in.study.limit_over_fastest = in.root.optional_number("limit_times_fastest").value_or(in.study.limit_over_fastest);
  in.study.n_threads = in.root.whole_number("threads");
}

Study read(Document& document)
{
  StudyReader in(document);
  read_head(in);
  read_measure(in);
  in.study.settings = in.settings(in.root, "set");
  read_methods(in);
  read_points(in);
  in.study.refine = in.pointer(in.root, "refine");
  read_quantities(in);
  read_reference(in);
  read_budget(in);
  read_expectations(in);
  read_stability(in);
  read_stable_if(in);
  read_map(in);
  read_limits(in);
  in.root.finish();
  expect_answers(in);
  expect_few_points(in);
  return std::move(in.study);
}

}  // namespace

Study read_study(const std::filesystem::path& file, bool in_short)
{
  Document document(file, study_keys());
  if (in_short && document.root.contains("short")) {
    const Json patch = document.root["short"];
    if (!patch.is_object()) throw InputError({file.string() + "#/short", patch.type_name(), "expected an object"});
    document.root.merge_patch(patch);
  }
  Study study = read(document);
  if (!document.problems.empty()) throw InputError(std::move(document.problems));
  return study;
}

}  // namespace tamp::tools::study
