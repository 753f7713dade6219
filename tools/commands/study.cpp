#include "tools/study/run_study.hpp"

#include <fmt/format.h>

#include <memory>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"
#include "tools/study/limit/find_limits.hpp"
#include "tools/system/errors.hpp"

namespace tamp::tools
{

namespace
{

struct StudyArguments {
  study::StudyOptions study;
  study::LimitOptions limit;
  std::vector<double> between;
};

/// Checks the options that go with --limit alone, and runs the command that the options ask for.
void run(StudyArguments& arguments)
{
  const std::vector<double>& ends = arguments.between;
  if (!ends.empty() && ends[0] >= ends[1]) {
    throw InputError(
        {"--between", fmt::format("{} and {}", ends[0], ends[1]), "expected the lower value first: LOW,HIGH"});
  }
  if (!ends.empty()) arguments.limit.search.between = {ends[0], ends[1]};
  if (arguments.limit.pointer.empty()) return run_study(arguments.study);
  find_limits(arguments.study, arguments.limit);
}

void add_limit_options(CLI::App& command, StudyArguments& arguments)
{
  study::LimitOptions& limit = arguments.limit;
  CLI::Option* pointer = command
                             .add_option("--limit", limit.pointer,
                                         "look for the value of a setting at which each method, or the scene, stops "
                                         "being stable, instead of running the study")
                             ->type_name("POINTER")
                             ->check(is_not_empty())
                             ->excludes("--steps");
  command
      .add_option("--between", arguments.between, "values between which it lies; else doubled or halved until found")
      ->type_name("LOW,HIGH")
      ->delimiter(',')
      ->expected(2)
      ->check(is_above_zero())
      ->needs(pointer);
  command.add_option("--within", limit.search.within, "how close the limit is to be known, relative")
      ->type_name("PART")
      ->check(is_from_to(1e-5, 1))
      ->capture_default_str()
      ->needs(pointer);
  command.add_option("--runs", limit.search.most_runs, "the most runs of a method")
      ->type_name("N")
      ->check(is_whole_from(2))
      ->capture_default_str()
      ->needs(pointer);
  command
      .add_option("--energy-error", limit.energy_error,
                  "a run whose energy is wrong by more, relative, is not stable; over the study's stable_if")
      ->type_name("PART")
      ->check(is_above_zero())
      ->needs(pointer);
}

}  // namespace

CLI::App* add_study_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("study", "Sweep settings, and chart speed against accuracy");
  const auto arguments = std::make_shared<StudyArguments>();
  study::StudyOptions* options = &arguments->study;
  command->add_option("STUDY", options->file, "the study's JSON file; with --limit a scene's too")
      ->type_name("FILE")
      ->required();
  command->add_option("--out", options->folder, "the study's folder; by default studies/ and the study's name")
      ->type_name("DIR");
  command->add_flag("--short", options->in_short, "the study's short form");
  command->add_option("--steps", options->most_steps, "a rehearsal: each run ends after so many steps")
      ->check(is_whole_from(1));
  command->add_flag("--force", options->force, "remove results of another program from the folder");
  command->add_flag("--quiet", options->quiet, "print no progress and no table");
  add_limit_options(*command, *arguments);
  command->footer(examples(
      {{"tamp study inputs/studies/bar.json --short", "a small study, in half a minute"},
       {"tamp study inputs/studies/punch.json --steps 20", "whether all of its runs can be run, in a minute"},
       {"tamp study inputs/studies/punch.json --out studies/punch", "hours; started again it goes on"},
       {"tamp study inputs/studies/bar.json --limit /time/multiplier", "how large steps each method endures"}}));
  command->callback([arguments] { run(*arguments); });
  return command;
}

}  // namespace tamp::tools
