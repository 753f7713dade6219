#include "tools/study/run_study.hpp"

#include <memory>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/commands.hpp"

namespace tamp::tools
{

CLI::App* add_study_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("study", "Sweep settings, and chart speed against accuracy");
  const auto options = std::make_shared<study::StudyOptions>();
  command->add_option("STUDY", options->file, "the study's JSON file")->type_name("FILE")->required();
  command->add_option("--out", options->folder, "the study's folder; by default studies/ and the study's name")
      ->type_name("DIR");
  command->add_flag("--short", options->in_short, "the study's short form");
  command->add_flag("--force", options->force, "remove results of another program from the folder");
  command->add_flag("--quiet", options->quiet, "print no progress and no table");
  command->footer(
      examples({{"tamp study inputs/studies/bar.json --short", "a small study, in half a minute"},
                {"tamp study inputs/studies/punch.json --out studies/punch", "hours; started again it goes on"}}));
  command->callback([options] { run_study(*options); });
  return command;
}

}  // namespace tamp::tools
