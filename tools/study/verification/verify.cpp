#include "tools/study/verification/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <fstream>

#include "runtime/file_error.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/scene/input_file.hpp"
#include "tools/scene/output_file.hpp"
#include "tools/scene/print_json.hpp"
#include "tools/study/verification/verification_table.hpp"
#include "tools/system/child_process.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/machine.hpp"
#include "tools/system/shipped_inputs.hpp"
#include "tools/system/suggestion.hpp"
#include "tools/system/usable_cores.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::verify
{

namespace
{

namespace fs = std::filesystem;

/// The studies that there are, in the order of their names.
std::vector<fs::path> shipped_studies()
{
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(shipped_input("verification"))) {
    if (entry.path().extension() == ".json") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

std::vector<fs::path> chosen_studies(const std::vector<std::string>& names)
{
  const std::vector<fs::path> all = shipped_studies();
  if (names.empty()) return all;
  std::vector<std::string> known;
  known.reserve(all.size());
  for (const fs::path& file : all) known.push_back(file.stem());
  std::vector<fs::path> chosen;
  for (const std::string& name : names) {
    const auto at = std::find(known.begin(), known.end(), name);
    if (at == known.end()) {
      throw InputError({name, "no study of inputs/verification",
                        meant_or(name, known, fmt::format("expected one of {}", fmt::join(known, ", ")))});
    }
    const fs::path& file = all[static_cast<std::size_t>(at - known.begin())];
    // One named twice runs once: both would write into one folder.
    if (std::find(chosen.begin(), chosen.end(), file) == chosen.end()) chosen.push_back(file);
  }
  return chosen;
}

Child study_command(const VerifyOptions& options, const fs::path& file)
{
  const fs::path folder = options.folder / file.stem();
  Child child{{"study", file.string(), "--out", folder.string(), "--quiet"}, folder.string() + ".errors"};
  if (options.in_short) child.arguments.push_back("--short");
  if (options.force) child.arguments.push_back("--force");
  return child;
}

/// A reference that failed is one of the failures, and keeps nothing else from being judged.
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

/// Before the studies run, not after them.
void make_folder(const fs::path& folder)
{
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) throw runtime::FileError(folder.string(), error.message());
  for (const char* name : {"verification.json", "verification.md"}) runtime::expect_writable(folder / name);
}

/// Processes of their own, as HDF5 works on one thread at a time. Returns what went wrong with references.
std::vector<std::string> run_studies(const VerifyOptions& options, const std::vector<fs::path>& files)
{
  make_folder(options.folder);
  std::vector<Child> children;
  children.reserve(files.size());
  for (const fs::path& file : files) children.push_back(study_command(options, file));
  std::vector<std::string> failures;
  const int n_at_once = options.n_jobs > 0 ? options.n_jobs : usable_cores().of_rank;
  run_children(children, n_at_once, [&](std::size_t i, const ChildEnd& end) {
    const std::string name = files[i].stem();
    expect_study(name, children[i], end, failures);
    if (!options.quiet) print_err("{}: {:.0f} s of processor time\n", name, end.user_s);
  });
  return failures;
}

}  // namespace

void verify(const VerifyOptions& options)
{
  const std::vector<fs::path> files = chosen_studies(options.names);
  for (const fs::path& file : files) expect_input_file(file);
  expect_outputs({{"--json", options.json}});
  std::vector<std::string> failures = run_studies(options, files), known_misses, held_misses;
  std::vector<Json> studies;
  std::size_t n_expectations = 0;
  for (const fs::path& file : files) {
    const Json& study = studies.emplace_back(Json::parse(std::ifstream(options.folder / file.stem() / "study.json")));
    const auto note_all = [&](const std::vector<std::string>& lines, std::vector<std::string>& all) {
      for (const std::string& line : lines) all.push_back(file.stem().string() + ": " + line);
    };
    note_all(failures_of(study), failures);
    note_all(known_misses_of(study), known_misses);
    note_all(held_misses_of(study), held_misses);
    n_expectations += study["gates"].size();
  }
  const std::string table = to_markdown(studies);
  const Json json{{"program", version_text()}, {"machine", machine_json()},    {"short", options.in_short},
                  {"failures", failures},      {"known_misses", known_misses}, {"held_misses", held_misses},
                  {"studies", studies}};
  runtime::write_whole_file(options.folder / "verification.json", json_text(json, 1) + "\n");
  runtime::write_whole_file(options.folder / "verification.md", table);
  if (!options.json.empty()) runtime::write_whole_file(options.json, json_text(to_list(studies), 1) + "\n");
  if (!options.quiet) print_out("{}", table);
  for (const std::string& held : held_misses) {
    print_err("tamp: holds, though its study lists it under \"missed\": {}\n", held);
  }
  if (!options.quiet) {
    print_err("of {} expectations {} are known to be missed, {} of them hold; {} of the others do not\n",
              n_expectations, known_misses.size() + held_misses.size(), held_misses.size(), failures.size());
  }
  if (failures.empty()) return;
  throw tasks::SimulationError(
      fmt::format("{} of {} expectations that are to hold do not:\n{}", failures.size(),
                  n_expectations - known_misses.size() - held_misses.size(), fmt::join(failures, "\n")),
      "", -1, {});
}

}  // namespace tamp::tools::verify
