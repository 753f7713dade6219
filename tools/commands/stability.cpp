#include "tools/study/stability/stability.hpp"

#include <memory>

#include "tools/commands/command_line/batch_options.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/commands.hpp"

namespace tamp::tools
{

CLI::App* add_stability_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand(
      "stability", "Show how methods fail, and which survive: the failure catalogue, the studies of inputs/stability");
  const auto batch = std::make_shared<study::StudyBatch>(study::StudyBatch{"stability", "runs/stability"});
  add_batch_options(*command, *batch, "stability.json and stability.md", "a list of what failed and what survived");
  command->footer(
      examples({{"tamp stability null_space", "one entry, in a second"}, {"tamp stability", "all of them"}}));
  command->callback([batch] { stability::run_catalogue(*batch); });
  return command;
}

}  // namespace tamp::tools
