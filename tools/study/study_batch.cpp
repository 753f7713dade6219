#include "tools/study/study_batch.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "runtime/file_error.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/system/child_process.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/shipped_inputs.hpp"
#include "tools/system/suggestion.hpp"
#include "tools/system/usable_cores.hpp"

namespace tamp::tools::study
{

namespace
{

namespace fs = std::filesystem;

/// The studies that there are, in the order of their names.
std::vector<fs::path> shipped_studies(const std::string& inputs)
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(shipped_input(inputs))) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

Child study_command(const StudyBatch& batch, const fs::path& file)
{
  const fs::path folder = batch.folder / file.stem();
  Child child{{"study", file.string(), "--out", folder.string(), "--quiet"}, folder.string() + ".errors"};
  if (batch.in_short) child.arguments.push_back("--short");
  if (batch.most_steps) child.arguments.insert(child.arguments.end(), {"--steps", std::to_string(*batch.most_steps)});
  if (batch.force) child.arguments.push_back("--force");
  return child;
}

/// A reference that failed is one of the failures.
void expect_study(const std::string& name, const Child& child, const ChildEnd& end, std::vector<std::string>& failures)
{
  const std::string said = error_text_of(child);
  fs::remove(child.errors);
  if (end.done()) return;
  if (end.exit_code == static_cast<int>(ExitCode::bad_input)) throw InputError({name, said, ""});
  if (end.exit_code != static_cast<int>(ExitCode::bad_simulation)) {
    throw runtime::FileError(name, said.empty() ? "the study ended with " + end.description() : said);
  }
  failures.push_back(name + ": " + said);
}

}  // namespace

std::vector<fs::path> chosen_studies(const StudyBatch& batch)
{
  const std::vector<fs::path> all = shipped_studies(batch.inputs);
  if (batch.names.empty()) return all;
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const fs::path& file : all) known.push_back(file.stem());
  std::vector<fs::path> chosen;
  for (const std::string& name : batch.names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      throw InputError({name, "no study of inputs/" + batch.inputs,
                        meant_or(name, known, fmt::format("expected one of {}", fmt::join(known, ", ")))});
    }
    const fs::path& file = all[static_cast<std::size_t>(at - known.begin())];
    // A study that is named twice runs once: both would write into one folder.
    if (std::find(chosen.begin(), chosen.end(), file) == chosen.end()) chosen.push_back(file);
  }
  return chosen;
}

void make_folder(const StudyBatch& batch, const std::vector<std::string>& outputs)
{
  std::error_code error;
  fs::create_directories(batch.folder, error);
  if (error) throw runtime::FileError(batch.folder.string(), error.message());
  expect_results(batch.folder, outputs);
}

std::vector<std::string> run_studies(const StudyBatch& batch, const std::vector<fs::path>& files)
{
  std::vector<Child> children;
  children.reserve(files.size());
  for (const fs::path& file : files) children.push_back(study_command(batch, file));
  std::vector<std::string> failures;
  const int n_at_once = batch.n_jobs > 0 ? batch.n_jobs : usable_cores().of_rank;
  run_children(children, n_at_once, [&](std::size_t i, const ChildEnd& end) {
    const std::string name = files[i].stem();
    expect_study(name, children[i], end, failures);
    if (!batch.quiet) print_err("{}: {:.0f} s of processor time\n", name, end.user_s);
  });
  return failures;
}

Json results_of(const StudyBatch& batch, const fs::path& file)
{
  return Json::parse(std::ifstream(batch.folder / file.stem() / "study.json"));
}

}  // namespace tamp::tools::study
