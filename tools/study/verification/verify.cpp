#include "tools/study/verification/verify.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/scene/files/input_file.hpp"
#include "tools/scene/files/output_file.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/study/verification/verification_table.hpp"
#include "tools/system/console.hpp"
#include "tools/system/machine.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::verify
{

namespace fs = std::filesystem;

void verify(const study::StudyBatch& options)
{
  const std::vector<fs::path> files = chosen_studies(options);
  for (const fs::path& file : files) expect_input_file(file);
  note_shipped_inputs();
  expect_outputs({{"--json", options.json}});
  make_folder(options, {"verification.json", "verification.md"});
  std::vector<std::string> failures = run_studies(options, files), known_misses, held_misses;
  std::vector<Json> studies;
  std::size_t n_expectations = 0;
  for (const fs::path& file : files) {
    const Json& study = studies.emplace_back(results_of(options, file));
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
  if (failures.empty() || options.most_steps) return;
  throw tasks::SimulationError(
      fmt::format("{} of {} expectations that are to hold do not:\n{}", failures.size(),
                  n_expectations - known_misses.size() - held_misses.size(), fmt::join(failures, "\n")),
      "", -1, {});
}

}  // namespace tamp::tools::verify
