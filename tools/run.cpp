#include "tools/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <vector>

#include "runtime/data/byte_stream.hpp"
#include "runtime/profile/report.hpp"
#include "runtime/ranks/together.hpp"
#include "runtime/storage/field_file.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/moments.hpp"
#include "tools/progress.hpp"
#include "tools/run_folder.hpp"
#include "tools/run_history.hpp"
#include "tools/run_summary.hpp"
#include "tools/scene/compiled_moduli.hpp"
#include "tools/signals.hpp"

namespace tamp::tools
{

namespace
{

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// What one rank may ask of all with a step, as bits.
enum Request : unsigned { write_checkpoint = 1, stop_terminated = 2, stop_interrupted = 4 };

std::shared_ptr<runtime::Executor> executor_of(const RunOptions& options)
{
  if (options.shuffle_seed) return runtime::Executor::shuffled(*options.shuffle_seed, options.executor);
  return std::make_shared<runtime::Executor>(options.n_threads, options.executor);
}

/// The last steps with output.
struct OutputSteps {
  long history = -1;
  long fields = -1;
};

class Runner
{
 public:
  Runner(const CheckedScene& checked, const RunOptions& options)
      : checked_(checked),
        options_(options),
        executor_(executor_of(options)),
        signals_(*executor_),
        simulation_(tasks::Simulation::make(checked.scene, executor_, options.communicator)),
        history_(*simulation_),
        fields_moment_(checked.scene.output.fields_interval),
        history_moment_(checked.scene.output.history_interval),
        checkpoint_clock_(options.checkpoints),
        end_(std::min(checked.scene.time.end, options.until))
  {
    simulation_->balance_every(options.balance_interval);
    if (options.restart) {
      restart();
    } else {
      fields_.emplace(options.folder, options.communicator);
      history_.begin(options.folder);
    }
    by_first([&] { runtime::write_whole_file(options_.folder / "scene.json", checked_.resolved.dump(2) + "\n"); });
  }

  void run()
  {
    const std::size_t n = n_particles();
    Progress progress(options_.quiet || !is_first(), end_, options_.max_steps, n);
    write_due();
    while (simulation_->time() < end_ && simulation_->n_steps() < options_.max_steps) {
      const Clock::time_point begin = Clock::now();
      ask_for_what_is_wanted();
      try {
        simulation_->advance(end_);
      } catch (const tasks::SimulationError& error) {
        progress.finish();
        fail(error);
      }
      step_seconds_.push_back(static_cast<float>(seconds_since(begin)));
      write_due();
      keep_state();
      if (stopping_signal() != 0) {
        progress.finish();
        leave();
      }
      progress.show(simulation_->n_steps(), simulation_->time(), simulation_->last_step_size());
    }
    progress.finish();
    write_last_state();
    finish("completed", "");
  }

 private:
  bool is_first() const { return options_.communicator.is_first(); }

  template <class Work>
  void by_first(const Work& work) const
  {
    runtime::by_first(options_.communicator, work);
  }

  std::size_t n_particles() const
  {
    std::size_t n = 0;
    for (std::size_t m = 0; m < simulation_->scene().materials.size(); ++m) {
      n += simulation_->n_particles(static_cast<int>(m));
    }
    return n;
  }

  void restart()
  {
    const auto found = checkpoint_to_restart(options_.folder, checked_, options_.communicator);
    const std::vector<std::byte> own = simulation_->restart(found);
    runtime::ByteReader(own).read(due_);
    written_ = due_;
    restarted_at_ = simulation_->n_steps();
    history_.go_on(options_.folder, due_.history);
    fields_.emplace(runtime::FieldFile::continued(options_.folder, due_.fields, options_.communicator));
    history_moment_.skip_to(simulation_->time());
    fields_moment_.skip_to(simulation_->time());
    checkpoint_clock_.skip_to(simulation_->time());
    if (!is_first()) return;
    if (!fields_->notice().empty()) fmt::print(stderr, "tamp: {}\n", fields_->notice());
    if (!options_.quiet) {
      fmt::print("going on from {}, step {}, time {:.6g} s\n", found.file.string(), restarted_at_, simulation_->time());
    }
  }

  void write_due()
  {
    if (history_moment_.due(simulation_->time())) {
      write_history();
      due_.history = simulation_->n_steps();
    }
    if (fields_moment_.due(simulation_->time())) {
      write_fields();
      due_.fields = simulation_->n_steps();
    }
  }

  void write_history()
  {
    history_.write_row();
    written_.history = simulation_->n_steps();
  }

  void write_fields()
  {
    const auto watch = executor_->watch("writing fields");
    const auto particles = simulation_->particle_columns();
    // What is on the grid is no state: after a restart there is nothing there before the first step.
    std::optional<runtime::NodeBlock> nodes;
    if (simulation_->n_steps() != restarted_at_) nodes = simulation_->node_columns();
    fields_->write_step(simulation_->n_steps(), simulation_->time(), particles, nodes);
    written_.fields = simulation_->n_steps();
  }

  void write_last_state()
  {
    if (written_.history != simulation_->n_steps()) write_history();
    if (written_.fields != simulation_->n_steps()) write_fields();
  }

  /// What this rank alone knows, all learn with the next step.
  void ask_for_what_is_wanted()
  {
    const int signal = signals_.noted();
    if (signal == SIGTERM) simulation_->ask(stop_terminated);
    if (signal == SIGINT) simulation_->ask(stop_interrupted);
    if (is_first() && checkpoint_clock_.wall_time_over()) simulation_->ask(write_checkpoint);
  }

  int stopping_signal() const
  {
    if ((simulation_->asked() & stop_terminated) != 0) return SIGTERM;
    return (simulation_->asked() & stop_interrupted) != 0 ? SIGINT : 0;
  }

  void keep_state()
  {
    const bool due = checkpoint_clock_.due(simulation_->n_steps(), simulation_->time());
    if (!due && simulation_->asked() == 0) return;
    const auto watch = executor_->watch("writing a checkpoint");
    runtime::ByteWriter own;
    own.add(due_);
    simulation_->write_checkpoint(options_.folder / "checkpoints", fingerprint(checked_), own.bytes(),
                                  options_.checkpoints.keep);
    checkpoint_clock_.written();
  }

  /// After a signal; the state has been kept.
  [[noreturn]] void leave()
  {
    write_last_state();
    const std::string reason = fmt::format("stopped by a signal at step {}, time {:.6g} s; to go on: --restart {}",
                                           simulation_->n_steps(), simulation_->time(), options_.folder.string());
    finish("interrupted", reason);
    throw Interrupted(reason, stopping_signal());
  }

  /// Keeps what is good, and passes the error on with where in the run it happened.
  [[noreturn]] void fail(const tasks::SimulationError& error)
  {
    write_last_state();
    const std::string reason =
        fmt::format("step {}, time {:.6g} s: {}; the state before that step is the last in {}", simulation_->n_steps(),
                    simulation_->time(), error.what(), (options_.folder / "fields.h5").string());
    finish("unstable", reason);
    throw tasks::SimulationError(reason, error.material, -1, {});
  }

  void finish(const std::string& status, const std::string& reason)
  {
    history_.measure();
    const runtime::Profile profile = simulation_->profile();
    const nlohmann::json json = to_json(profile, simulation_->ledger(), options_.communicator);
    const nlohmann::ordered_json told = run_summary(
        *simulation_, history_, {status, reason, seconds_since(start_), median_step_seconds(), restarted_at_});
    by_first([&] {
      runtime::write_whole_file(options_.folder / "profile.json", json.dump(1) + "\n");
      runtime::write_whole_file(options_.folder / "trace.json", runtime::trace_to_json(profile).dump() + "\n");
      runtime::write_whole_file(options_.folder / "summary.json", told.dump(2) + "\n");
    });
    if (options_.quiet || !is_first()) return;
    fmt::print("{}\n{}  written to {}\n", runtime::to_text(json, 10), told_in_short(told), options_.folder.string());
  }

  double median_step_seconds()
  {
    if (step_seconds_.empty()) return 0;
    const auto middle = step_seconds_.begin() + static_cast<std::ptrdiff_t>(step_seconds_.size() / 2);
    std::nth_element(step_seconds_.begin(), middle, step_seconds_.end());
    return *middle;
  }

  const CheckedScene& checked_;
  const RunOptions& options_;
  Clock::time_point start_ = Clock::now();
  std::shared_ptr<runtime::Executor> executor_;
  SignalWatch signals_;
  std::unique_ptr<tasks::Simulation> simulation_;
  RunHistory history_;
  std::optional<runtime::FieldFile> fields_;
  Every fields_moment_;
  Every history_moment_;
  CheckpointClock checkpoint_clock_;
  double end_;
  /// Written because it was due: what a stopped run wrote later, it wrote as it left.
  OutputSteps due_;
  OutputSteps written_;
  long restarted_at_ = -1;
  std::vector<float> step_seconds_;
};

}  // namespace

void run(const CheckedScene& scene, const RunOptions& options)
{
  if (!options.restart) {
    runtime::by_first(options.communicator, [&] { prepare_run_folder(options.folder, options.force); });
  }
  if (!options.quiet && options.communicator.is_first()) {
    for (const std::string& line : compiled_moduli(scene)) fmt::print("{}\n", line);
  }
  Runner(scene, options).run();
}

}  // namespace tamp::tools
