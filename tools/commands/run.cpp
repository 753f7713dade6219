#include "tools/run.hpp"

#include <memory>

#include "tools/commands/commands.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/usable_cores.hpp"

namespace tamp::tools
{

namespace
{

struct Options {
  std::string scene;
  std::vector<std::string> assignments;
  std::string out;
  RunOptions run;
};

}  // namespace

CLI::App* add_run_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("run", "Run a scene and write its folder");
  const auto options = std::make_shared<Options>();
  options->run.n_threads = usable_cores();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->required();
  command->add_option("--out", options->out, "the run's folder; by default runs/ and the scene's name");
  command->add_option("--set", options->assignments, "POINTER=VALUE: replace a value of the scene, may be repeated")
      ->allow_extra_args(false);
  command->add_option("--threads", options->run.n_threads, "threads; by default the cores that may be used")
      ->check(CLI::Range(1, 1024));
  command->add_option("--until", options->run.until, "stop at this simulated time, in seconds")
      ->check(CLI::PositiveNumber)
      ->default_str("the scene's end");
  command->add_option("--steps", options->run.max_steps, "stop after so many steps")
      ->check(CLI::PositiveNumber)
      ->default_str("no limit");
  command->add_flag("--force", options->run.force, "replace what an earlier run left in the folder");
  command->add_flag("--quiet", options->run.quiet, "print no progress and no table");
  command->callback([options] {
    const CheckedScene scene = read_scene(options->scene, options->assignments);
    options->run.folder = options->out.empty() ? "runs/" + scene.scene.name : options->out;
    run(scene, options->run);
  });
  return command;
}

}  // namespace tamp::tools
