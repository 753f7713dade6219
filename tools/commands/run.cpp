#include "tools/run/run.hpp"

#include <fmt/core.h>

#include <memory>

#include "tools/commands/command_line/assignments.hpp"
#include "tools/commands/command_line/command_text.hpp"
#include "tools/commands/command_line/help_text.hpp"
#include "tools/commands/command_line/option_checks.hpp"
#include "tools/commands/command_line/trace_steps.hpp"
#include "tools/commands/commands.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/console.hpp"
#include "tools/system/shell_word.hpp"
#include "tools/system/signals.hpp"
#include "tools/system/usable_cores.hpp"

namespace tamp::tools
{

namespace
{

struct RunArguments {
  std::string scene;
  std::vector<std::string> assignments;
  std::string out;
  std::string restart;
  /// 0: this rank's share of the cores.
  int n_threads = 0;
  std::string schedule = "parallel";
  std::string trace_steps = "20";
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
  run.executor.window = 1;
  if (schedule != "serial") run.shuffle_seed = std::stoull(schedule.substr(schedule.find(':') + 1));
}

void add_checkpoint_options(CLI::App& command, CheckpointPolicy& policy)
{
  command.add_option("--checkpoint-steps", policy.steps, "write a checkpoint every so many steps")
      ->check(is_whole_from(1))
      ->default_str("never");
  command
      .add_option("--checkpoint-time", policy.simulated, "write a checkpoint every so many seconds of simulated time")
      ->check(is_above_zero())
      ->default_str("never");
  command.add_option("--checkpoint-wall", policy.wall, "write a checkpoint every so many seconds of wall time")
      ->check(is_above_zero());
  command.add_option("--checkpoint-keep", policy.keep, "how many checkpoints stay, the newest")
      ->check(is_whole_from_to(1, 1000));
}

void expect_few_checkpoints(const CheckpointPolicy& policy, double end)
{
  constexpr double most = 1e5;
  const double n = end / policy.simulated;
  if (n <= most) return;
  throw InputError({"--checkpoint-time",
                    fmt::format("{} s: {:.3g} checkpoints until the end, {} s", policy.simulated, n, end),
                    fmt::format("expected at most {:.3g}", most)});
}

/// A range of which the run has no step.
void expect_traced_steps(const std::string& trace_steps, const RunOptions& run)
{
  if (run.traced_steps.first <= run.max_steps) return;
  throw InputError({"--trace-steps", trace_steps,
                    fmt::format("expected steps up to {}, where --steps ends the run", run.max_steps)});
}

/// Ranks that share cores are slow, and slower still if those who wait do not let go of them.
void look_at_cores(int n_threads, RunOptions& run)
{
  const UsableCores cores = usable_cores(run.communicator);
  run.n_threads = n_threads == 0 ? cores.of_rank : n_threads;
  const int wanted = cores.ranks_on_machine * run.n_threads;
  run.executor.oversubscribed = wanted > cores.of_machine;
  if (wanted <= cores.of_machine || run.quiet || !run.communicator.is_first()) return;
  print_err("tamp: {} ranks with {} threads each on {} cores: expect a slow run{}\n", cores.ranks_on_machine,
            run.n_threads, cores.of_machine,
            run.communicator.size() > 1 ? "; mpirun binds ranks to cores unless told --bind-to none" : "");
}

/// The command that goes on with what this one leaves.
std::string command_to_go_on(const CLI::App& command, const std::vector<const CLI::Option*>& without,
                             const RunOptions& run)
{
  const int n_ranks = run.communicator.size();
  return (n_ranks > 1 ? fmt::format("mpirun -np {} ", n_ranks) : "") + command_text(command, without) + " --restart " +
         shell_word(run.folder.string());
}

}  // namespace

CLI::App* add_run_command(CLI::App& app)
{
  CLI::App* command = app.add_subcommand("run", "Run a scene and write its folder");
  const auto options = std::make_shared<RunArguments>();
  options->run.communicator = runtime::Communicator::world();
  command->add_option("SCENE", options->scene, "the scene's JSON file")->type_name("FILE")->required();
  CLI::Option* out =
      command->add_option("--out", options->out, "the run's folder; by default runs/ and the scene's name")
          ->type_name("DIR")
          ->check(is_not_empty());
  add_assignments(*command, options->assignments, "scene");
  command->add_option("--threads", options->n_threads, "threads of each rank")
      ->check(is_whole_from_to(1, 1024))
      ->default_str("its share of the cores");
  command
      ->add_option("--schedule", options->schedule,
                   "parallel; serial: program order on one thread; shuffle:SEED: random orders that the graph allows")
      ->check(CLI::Validator(schedule_problem, ""));
  command->add_option("--until", options->run.until, "stop at this simulated time, in seconds")
      ->check(is_above_zero())
      ->default_str("the scene's end");
  command->add_option("--steps", options->run.max_steps, "stop after so many steps")
      ->check(is_whole_from(1))
      ->default_str("no limit");
  CLI::Option* force =
      command->add_flag("--force", options->run.force, "replace what an earlier run left in the folder");
  CLI::Option* restart =
      command->add_option("--restart", options->restart, "resume the run in this folder from its newest checkpoint")
          ->type_name("DIR")
          ->check(is_not_empty())
          ->excludes(out)
          ->excludes(force);
  add_checkpoint_options(*command, options->run.checkpoints);
  command
      ->add_option("--balance", options->run.balance_interval,
                   "check the load balance every so many steps; 0: patches stay where they are")
      ->check(is_whole_from(0));
  command
      ->add_option("--stall-limit", options->run.executor.stall.limit,
                   "end the run, saying what it waits for, if no task completes for so many seconds")
      ->check(is_above_zero());
  command
      ->add_option("--wall-limit", options->run.wall_limit,
                   "stop after so many seconds of the clock, with the state kept for --restart")
      ->check(is_above_zero())
      ->default_str("no limit");
  command
      ->add_option(
          "--trace-steps", options->trace_steps,
          "which steps to trace, in trace.json: N (the first N), FIRST:LAST (both included; the first step is 1), "
          "slowest, or none; at most about 100 MB")
      ->type_name("STEPS")
      ->check(is_trace_choice());
  command->add_flag("--strict", options->run.strict, "let a run that completes with warnings end with exit code 3");
  command->add_flag("--quiet", options->run.quiet, "print no progress and no table");
  command->footer(examples(
      {{"tamp run inputs/punch/quick.json --out runs/punch", "the punch, some seconds on two cores"},
       {"tamp run inputs/punch/quick.json --set /materials/sand/modulus/type=svr", "with another model of the sand"},
       {"mpirun -np 2 tamp run inputs/uxo/quick.json", "over two ranks"},
       {"tamp run inputs/punch/quick.json --restart runs/punch", "go on from its newest checkpoint"}}));
  command->callback([options, command, out, force, restart] {
    note_early_signals();
    const CheckedScene scene = read_scene(options->scene, options->assignments);
    if (options->run.communicator.is_first()) print_notes(scene.notes);
    expect_few_checkpoints(options->run.checkpoints, scene.scene.time.end);
    options->run.traced_steps = trace_choice(options->trace_steps);
    expect_traced_steps(options->trace_steps, options->run);
    options->run.restart = restart->count() > 0;
    options->run.folder = options->run.restart ? options->restart
                          : out->count() > 0   ? options->out
                                               : "runs/" + scene.scene.name;
    if (options->run.communicator.size() > 1) {
      options->run.executor.stall.prefix = fmt::format("rank {}: ", options->run.communicator.rank());
    }
    options->run.command_to_go_on = command_to_go_on(*command, {out, force, restart}, options->run);
    look_at_cores(options->schedule == "parallel" ? options->n_threads : 1, options->run);
    apply_schedule(options->schedule, options->run);
    run(scene, options->run);
  });
  return command;
}

}  // namespace tamp::tools
