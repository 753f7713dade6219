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
  std::string schedule = "parallel";
  RunOptions run;
};

/// "parallel", "serial" or "shuffle:SEED".
std::string schedule_problem(const std::string& schedule)
{
  const std::string prefix = "shuffle:";
  const bool seeded = schedule.starts_with(prefix) && schedule.size() > prefix.size() && schedule.size() < 28 &&
                      schedule.find_first_not_of("0123456789", prefix.size()) == std::string::npos;
  if (seeded || schedule == "parallel" || schedule == "serial") return {};
  return "found " + schedule + "; expected parallel, serial or shuffle:SEED";
}

void apply_schedule(const std::string& schedule, RunOptions& run)
{
  if (schedule == "parallel") return;
  run.n_threads = 1;
  if (schedule != "serial") run.shuffle_seed = std::stoull(schedule.substr(schedule.find(':') + 1));
}

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
  command
      ->add_option("--schedule", options->schedule,
                   "parallel; serial: program order on one thread; shuffle:SEED: random orders that the graph allows")
      ->check(CLI::Validator(schedule_problem, "parallel|serial|shuffle:SEED"));
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
    apply_schedule(options->schedule, options->run);
    options->run.folder = options->out.empty() ? "runs/" + scene.scene.name : options->out;
    run(scene, options->run);
  });
  return command;
}

}  // namespace tamp::tools
