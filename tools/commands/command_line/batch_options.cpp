#include "tools/commands/command_line/batch_options.hpp"

#include "tools/commands/command_line/option_checks.hpp"

namespace tamp::tools
{

void add_batch_options(CLI::App& command, study::StudyBatch& batch, const std::string& holds, const std::string& list)
{
  command.add_option("NAME", batch.names, "which studies; all without a name");
  command.add_option("--out", batch.folder, "holds a folder for each study, " + holds)->type_name("DIR");
  command.add_option("--json", batch.json, "write " + list + ", here too")->type_name("FILE");
  command.add_option("--steps", batch.most_steps, "a rehearsal: each run ends after so many steps; nothing is judged")
      ->check(is_whole_from(1));
  command.add_flag("--force", batch.force, "remove results of another program from the folders");
  command.add_flag("--quiet", batch.quiet, "print no progress and no table");
  command.add_option("--jobs", batch.n_jobs, "how many studies run at once; by default as many as there are cores")
      ->option_text("INT")
      ->check(is_whole_from(1));
}

}  // namespace tamp::tools
