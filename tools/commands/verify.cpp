#include "tools/study/verification/verify.hpp"

#include <memory>

#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/commands.hpp"

namespace tamp::tools
{

CLI::App* add_verify_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand(
      "verify", "Hold the methods against exact answers: the studies of inputs/verification, and what they expect");
  const auto options = std::make_shared<verify::VerifyOptions>();
  command->add_option("NAME", options->names, "which studies; all without a name");
  command->add_option("--out", options->folder, "holds a folder for each study, verification.json and verification.md")
      ->type_name("DIR");
  command->add_option("--json", options->json, "write a list of problems and methods, with orders and errors, here too")
      ->type_name("FILE");
  command->add_flag("--short", options->in_short, "the studies' short forms");
  command->add_flag("--force", options->force, "remove results of another program from the folders");
  command->add_flag("--quiet", options->quiet, "print no progress and no table");
  command->add_option("--jobs", options->n_jobs, "how many studies run at once; by default as many as there are cores")
      ->option_text("INT")
      ->check(is_whole_from(1));
  command->footer(
      examples({{"tamp verify bar --short", "one study in its short form"}, {"tamp verify --jobs 2", "all of them"}}));
  command->callback([options] { verify::verify(*options); });
  return command;
}

}  // namespace tamp::tools
