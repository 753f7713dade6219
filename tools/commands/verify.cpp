#include "tools/study/verification/verify.hpp"

#include <memory>

#include "tools/commands/command_line/batch_options.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/commands.hpp"

namespace tamp::tools
{

CLI::App* add_verify_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("verify", "Compare the methods with exact solutions");
  const auto batch = std::make_shared<study::StudyBatch>(study::StudyBatch{"verification", "runs/verify"});
  add_batch_options(*command, *batch, "verification.json and verification.md",
                    "a list of problems and methods, with orders and errors");
  command->add_flag("--short", batch->in_short, "the studies' short forms");
  command->footer(
      examples({{"tamp verify bar --short", "one study in its short form"}, {"tamp verify --jobs 2", "all of them"}}));
  command->callback([batch] { verify::verify(*batch); });
  return command;
}

}  // namespace tamp::tools
