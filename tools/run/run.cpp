#include "tools/run/run.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <optional>
#include <utility>
#include <vector>

#include "runtime/data/byte_stream.hpp"
#include "runtime/file_error.hpp"
#include "runtime/profile/report.hpp"
#include "runtime/profile/table.hpp"
#include "runtime/ranks/on_all_ranks.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/advice/plausibility.hpp"
#include "tools/run/forecast.hpp"
#include "tools/run/machine_history.hpp"
#include "tools/run/monitors.hpp"
#include "tools/run/output_times.hpp"
#include "tools/run/progress.hpp"
#include "tools/run/run_folder.hpp"
#include "tools/run/run_history.hpp"
#include "tools/run/run_machine.hpp"
#include "tools/run/run_output.hpp"
#include "tools/run/run_summary.hpp"
#include "tools/run/run_trace.hpp"
#include "tools/run/stop_reasons.hpp"
#include "tools/scene/compiled_moduli.hpp"
#include "tools/scene/json/print_json.hpp"
#include "tools/system/capacity.hpp"
#include "tools/system/console.hpp"
#include "tools/system/errors.hpp"
#include "tools/system/signals.hpp"
#include "tools/system/statistics.hpp"
#include "tools/system/usable_cores.hpp"

namespace tamp::tools
{

namespace
{

using Clock = std::chrono::steady_clock;

constexpr const char* summary_file = "summary.json";

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

/// Size of the files in a folder and below [bytes], without files that cannot be read and space that is reserved for
/// later.
double bytes_in(const std::filesystem::path& folder)
{
  double bytes = 0;
  std::error_code unreadable;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder, unreadable)) {
    const bool counts = entry.is_regular_file(unreadable) && entry.path().extension() != ".part";
    const auto size = counts ? entry.file_size(unreadable) : 0;
    if (!unreadable) bytes += static_cast<double>(size);
  }
  return bytes;
}

std::shared_ptr<runtime::Executor> executor_of(const RunOptions& options)
{
  return with_resources_for("starting threads", [&]() -> std::shared_ptr<runtime::Executor> {
    if (options.shuffle_seed) return runtime::Executor::shuffled(*options.shuffle_seed, options.executor);
    return std::make_shared<runtime::Executor>(options.n_threads, options.executor);
  });
}

std::unique_ptr<tasks::Simulation> simulation_of(const tasks::Scene& scene, std::shared_ptr<runtime::Executor> executor,
                                                 const RunOptions& options)
{
  return with_resources_for("laying out the particles",
                            [&] { return tasks::Simulation::make(scene, executor, options.communicator); });
}

/// The last steps with output, and how much of it there is until then.
struct Outputs {
  long history = -1;
  long fields = -1;
  runtime::CsvExtent rows;
  std::size_t n_fields = 0;
  LargestSoFar largest;
  BalanceSightings balances_above;
};

class Runner
{
 public:
  Runner(const CheckedScene& checked, const RunOptions& options, const Forecast& forecast,
         std::size_t resident_at_start)
      : checked_(checked),
        options_(options),
        forecast_(forecast),
        resident_at_start_(resident_at_start),
        machine_history_(options.communicator),
        folder_(own_folder()),
        executor_(executor_of(options)),
        signals_(*executor_),
        simulation_(simulation_of(checked.scene, executor_, options)),
        history_(*simulation_),
        output_(*simulation_, *executor_, output_options()),
        field_times_(checked.scene.output.fields_interval),
        history_times_(checked.scene.output.history_interval),
        checkpoint_clock_(options.checkpoints),
        end_(std::min(checked.scene.time.end, options.until))
  {
    simulation_->engine().balance_every(options.balance_interval);
    simulation_->engine().trace_steps(options.traced_steps);
    if (is_first()) warn_all(plausibility_warnings(checked));
    if (options.restart) {
      restart();
    } else {
      output_.begin();
      history_.begin(options.folder);
      machine_history_.begin(options.folder);
    }
    write("scene.json", json_text(checked_.resolved, 2));
    on_first_rank([&] { folder_->hold_room_for(summary_file); });
  }

  void run()
  {
    try {
      run_to_end();
    } catch (const runtime::FileError& error) {
      output_.settle();
      leave_summary(error.what());
      throw runtime::FileError(error.file, error.cause + how_to_go_on());
    }
    if (lost_output_) throw runtime::FileError(*lost_output_);
  }

 private:
  void run_to_end()
  {
    Progress progress(options_.quiet || !is_first(), end_, options_.max_steps, n_particles());
    parts_.set_up = seconds_since(start_);
    try {
      write_due();
      while (simulation_->time() < end_ && simulation_->n_steps() < options_.max_steps) {
        with_resources_for(fmt::format("after step {}", simulation_->n_steps()), [&] { advance(); });
        if (const StopReason* reason = stop_reason(simulation_->engine().asked())) {
          progress.finish();
          leave(*reason);
        }
        progress.show(simulation_->n_steps(), simulation_->time(), simulation_->last_step_size());
      }
    } catch (const tasks::SimulationError& error) {
      progress.finish();
      fail(error);
    }
    progress.finish();
    write_last_state();
    complete();
  }

  /// Takes one step, and writes the output that is due after it.
  void advance()
  {
    const Clock::time_point begin = Clock::now();
    ask_for_what_is_wanted();
    simulation_->advance(end_);
    const double seconds = seconds_since(begin);
    step_seconds_.push_back(static_cast<float>(seconds));
    parts_.steps += seconds;
    machine_history_.add_step(seconds);
    expect_energy();
    if ((simulation_->engine().asked() & end_as_output_has_failed) != 0) output_.finish();
    write_due();
    keep_state();
  }

  bool is_first() const { return options_.communicator.is_first(); }

  template <class Work>
  void on_first_rank(const Work& work) const
  {
    runtime::on_first_rank(options_.communicator, work);
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
    const std::vector<std::byte> own = simulation_->engine().restart(found);
    if (own.size() != sizeof(scheduled_)) {
      throw InputError({found.file.string(), "a checkpoint of another version of tamp",
                        "expected one that this version has written"});
    }
    runtime::ByteReader(own).read(scheduled_);
    written_ = scheduled_;
    restarted_at_ = simulation_->n_steps();
    warn(history_.resume(options_.folder, scheduled_.history, scheduled_.rows));
    machine_history_.resume(options_.folder, scheduled_.history);
    warn(output_.resume(scheduled_.fields, scheduled_.n_fields));
    scheduled_.rows = history_.extent();
    scheduled_.n_fields = output_.n_fields_at_start();
    history_.set_largest(scheduled_.largest);
    history_.set_balances_above(scheduled_.balances_above);
    history_times_.skip_to(simulation_->time());
    field_times_.skip_to(simulation_->time());
    checkpoint_clock_.skip_to(simulation_->time());
    if (options_.quiet || !is_first()) return;
    print_out("going on from {}, step {}, time {:.6g} s\n", found.file.string(), restarted_at_, simulation_->time());
  }

  /// The run's folder on the first rank, which alone writes it.
  std::unique_ptr<RunFolder> own_folder() const
  {
    std::unique_ptr<RunFolder> folder;
    on_first_rank([&] {
      const auto use = options_.restart ? RunFolder::Use::go_on
                       : options_.force ? RunFolder::Use::replace
                                        : RunFolder::Use::begin;
      std::vector<std::filesystem::path> inputs;
      for (const InputFile& input : checked_.inputs) inputs.push_back(input.file);
      folder = std::make_unique<RunFolder>(options_.folder, use, inputs);
      if (!folder->notice().empty()) print_err("tamp: {}\n", folder->notice());
    });
    return folder;
  }

  RunOutput::Options output_options() const
  {
    return {options_.folder, forecast_.in_background, options_.checkpoints.keep, [this] { folder_->expect_own(); }};
  }

  /// Prints a warning and keeps it for the summary; nothing if empty.
  void warn(const std::string& warning)
  {
    if (warning.empty()) return;
    if (is_first()) print_err("tamp: warning: {}\n", warning);
    warnings_.push_back(warning);
  }

  void warn_all(const std::vector<std::string>& warnings)
  {
    for (const std::string& warning : warnings) warn(warning);
  }

  void write_due()
  {
    if (history_times_.due(simulation_->time())) {
      write_history();
      scheduled_.history = simulation_->n_steps();
      scheduled_.rows = history_.extent();
    }
    if (field_times_.due(simulation_->time())) {
      write_fields();
      scheduled_.fields = simulation_->n_steps();
      ++scheduled_.n_fields;
    }
  }

  void expect_energy()
  {
    const std::string problem = history_.energy_problem(checked_.scene.limits.energy_error);
    if (problem.empty()) return;
    state_is_good_ = false;
    throw tasks::SimulationError(problem, "", -1, {});
  }

  void write_history()
  {
    const Clock::time_point begin = Clock::now();
    expect_own_folder();
    history_.write_row();
    machine_history_.write_row(simulation_->n_steps(), simulation_->time(),
                               simulation_->engine().warehouse().ledger().total().current());
    written_.history = simulation_->n_steps();
    history_seconds_ += seconds_since(begin);
  }

  void write_fields()
  {
    expect_own_folder();
    // The grid holds no state: after a restart there is nothing there before the first step.
    output_.write_fields(simulation_->n_steps() != restarted_at_);
    written_.fields = simulation_->n_steps();
  }

  void write_last_state()
  {
    if (written_.history != simulation_->n_steps()) write_history();
    if (written_.fields != simulation_->n_steps()) write_fields();
  }

  /// Requests of this rank alone reach all ranks with the next step.
  void ask_for_what_is_wanted()
  {
    const int signal = signals_.received();
    for (const StopReason& reason : stop_reasons) {
      if (signal == reason.signal && reason.request != wall_limit_reached.request)
        simulation_->engine().ask(reason.request);
    }
    if (!is_first()) return;
    if (output_.has_failed()) simulation_->engine().ask(end_as_output_has_failed);
    if (checkpoint_clock_.wall_time_over()) simulation_->engine().ask(checkpoint_wanted);
    if (seconds_since(start_) > options_.wall_limit) simulation_->engine().ask(wall_limit_reached.request);
  }

  /// Nothing more may be written into a folder that is another program's.
  void expect_own_folder() const
  {
    on_first_rank([&] { folder_->expect_own(); });
  }

  /// Writes a text into the folder.
  void write(const std::string& name, const std::string& text) const
  {
    on_first_rank([&] {
      folder_->expect_own();
      runtime::write_whole_file(options_.folder / name, text + "\n");
    });
  }

  void keep_state()
  {
    const bool due = checkpoint_clock_.due(simulation_->n_steps(), simulation_->time());
    if (!due && simulation_->engine().asked() == 0) return;
    write_checkpoint_now();
  }

  void write_checkpoint_now()
  {
    expect_own_folder();
    scheduled_.largest = history_.largest();
    scheduled_.balances_above = history_.balances_above();
    runtime::ByteWriter own;
    own.add(scheduled_);
    output_.write_checkpoint(fingerprint(checked_), own.bytes());
    checkpoint_clock_.written();
  }

  /// Ends a run that was asked to stop; its state has been kept.
  [[noreturn]] void leave(const StopReason& stop)
  {
    write_last_state();
    look_for_lost_output();
    const std::string reason = fmt::format("{}, after step {}, time {:.6g} s; to go on: {}", stop.words,
                                           simulation_->n_steps(), simulation_->time(), options_.command_to_go_on);
    finish("interrupted", reason);
    throw Interrupted(reason, stop.signal);
  }

  void complete()
  {
    const components::UpdateCounts& updates = simulation_->updates();
    if (updates.failures > 0) warn(fmt::format("{} stress updates have failed", updates.failures));
    history_.measure();
    look_for_lost_output();
    missed_ = miss_of_forecast();
    for (const Monitor& monitor : monitors_of(*simulation_, history_, missed_)) {
      if (monitor.warns()) warn(warning_of(monitor, checked_.scene));
    }
    const bool warned = common_warnings() > 0;
    finish(warned ? "completed with warnings" : "completed", "");
    if (!warned || !options_.strict || lost_output_) return;
    const std::string reason = "completed with warnings, which --strict does not take";
    throw tasks::SimulationError(reason, "", -1, {});
  }

  /// The miss of the forecast by a run that has come to its end. Known to the first rank alone, whose forecast it is.
  ForecastMiss miss_of_forecast() const
  {
    const runtime::MemoryLedger& ledger = simulation_->engine().warehouse().ledger();
    // The trace is not part of the forecast, as the scene does not say how many steps are traced.
    const std::size_t own = ledger.total().peak() - std::min(ledger.trace.peak(), ledger.total().peak());
    UsedByRun taken{static_cast<double>(options_.communicator.sum(own))};
    if (simulation_->time() >= checked_.scene.time.end) taken.n_steps = simulation_->n_steps();
    ForecastMiss missed;
    on_first_rank([&] {
      if (options_.checkpoints.keep <= n_checkpoints_forecast) taken.disk = bytes_in(options_.folder);
      missed = miss_of(forecast_, taken);
    });
    return missed;
  }

  /// Number of warnings of the first rank, which alone has those about files.
  std::size_t common_warnings() const { return options_.communicator.from_first(warnings_.size()); }

  /// Keeps the last good state, and passes the error on with the place in the run where it happened.
  [[noreturn]] void fail(const tasks::SimulationError& error)
  {
    instability_ = fmt::format("step {}, time {:.6g} s: {}", simulation_->n_steps(), simulation_->time(), error.what());
    if (state_is_good_) write_checkpoint_now();
    write_last_state();
    look_for_lost_output();
    const std::string reason =
        fmt::format("{}; the last state is kept in {}", instability_, (options_.folder / "fields.h5").string());
    finish("unstable", reason);
    // From a good state shorter steps may lead further.
    const std::string shorter =
        state_is_good_ ? fmt::format(" --set /time/multiplier={:.3g}", checked_.scene.time.multiplier / 2) : "";
    throw tasks::SimulationError(reason + how_to_go_on(shorter), error.material, -1, {});
  }

  /// After a failure, a line with the command that goes on from the newest checkpoint, with more settings; nothing if
  /// there is none.
  std::string how_to_go_on(const std::string& settings = "") const
  {
    const auto step = newest_step(options_.folder);
    if (!step || options_.command_to_go_on.empty()) return "";
    return fmt::format("\nto go on from step {}: {}{}", *step, options_.command_to_go_on, settings);
  }

  /// Warns at the end of a run of output that others have removed, replaced or emptied since it was written.
  void look_for_lost_output()
  {
    output_.finish();
    try {
      on_first_rank([&] {
        history_.expect_as_written();
        machine_history_.expect_as_written();
        output_.expect_as_written();
      });
    } catch (const runtime::FileError& lost) {
      lost_output_ = lost;
      warn(lost.what());
    }
  }

  /// Writes a summary after an output has failed, where there is none yet, as far as one can be written.
  void leave_summary(const std::string& failure)
  {
    if (has_summary_) return;
    try {
      if (instability_.empty()) {
        summarise("interrupted", failure);
      } else {
        summarise("unstable", instability_ + "; " + failure);
      }
    } catch (const runtime::FileError&) {
      return;  // the run reports what failed first
    }
  }

  void finish(const std::string& status, const std::string& reason)
  {
    output_.finish();
    const auto [summary, profile] = summarise(status, reason);
    // Written last, as it may be large, and a run can do without it.
    if (options_.traced_steps.kind != runtime::TraceChoice::Kind::none) write_trace();
    if (options_.quiet || !is_first()) return;
    print_out("{}\n{}  written to {}\n", runtime::to_text(profile, {.n_rows = 10}), summary_text(summary),
              options_.folder.string());
  }

  /// Writes `summary.json` and `profile.json`, and gives what they hold.
  std::pair<nlohmann::ordered_json, nlohmann::json> summarise(const std::string& status, const std::string& reason)
  {
    OutputTime output_time = output_.time();
    output_time.history = history_seconds_;
    parts_.output = output_time.history + output_time.fields + output_time.checkpoints + output_time.waited;
    const Clock::time_point last_output = Clock::now();
    history_.measure();
    const runtime::Profile profile = simulation_->engine().profile();
    nlohmann::json json = to_json(profile, simulation_->engine().warehouse().ledger(), options_.communicator);
    json["machine"] = machine();
    parts_.end = seconds_since(last_output);
    const nlohmann::ordered_json summary =
        run_summary(*simulation_, history_,
                    {status, reason, seconds_since(start_), median({step_seconds_.begin(), step_seconds_.end()}),
                     parts_, resident_at_start_, restarted_at_, output_.in_background(), output_time, forecast_,
                     missed_, checked_.inputs, checked_.left_out, warnings_});
    write(summary_file, json_text(summary, 2));
    has_summary_ = true;
    write("profile.json", json.dump(1));
    return {summary, json};
  }

  nlohmann::ordered_json machine() const { return run_machine(options_.communicator.size(), simulation_->n_threads()); }

  void write_trace()
  {
    const StepsRun run{std::max(restarted_at_, 0L) + 1, simulation_->n_steps()};
    const std::string missing =
        tools::write_trace(simulation_->engine(), options_.traced_steps, run, machine(), options_.folder);
    if (!missing.empty()) print_err("tamp: {}\n", missing);
  }

  const CheckedScene& checked_;
  const RunOptions& options_;
  const Forecast& forecast_;
  std::size_t resident_at_start_;
  Clock::time_point start_ = Clock::now();
  MachineHistory machine_history_;
  std::unique_ptr<RunFolder> folder_;
  std::shared_ptr<runtime::Executor> executor_;
  SignalWatch signals_;
  std::unique_ptr<tasks::Simulation> simulation_;
  RunHistory history_;
  RunOutput output_;
  OutputTimes field_times_;
  OutputTimes history_times_;
  CheckpointClock checkpoint_clock_;
  double end_;
  /// The last outputs that were written on schedule; what a run writes as it stops counts among `written_` alone.
  Outputs scheduled_;
  Outputs written_;
  long restarted_at_ = -1;
  bool state_is_good_ = true;
  /// Description of what went wrong in the simulation; empty if nothing did.
  std::string instability_;
  bool has_summary_ = false;
  std::optional<runtime::FileError> lost_output_;
  ForecastMiss missed_;
  double history_seconds_ = 0;
  WallParts parts_;
  std::vector<float> step_seconds_;
  std::vector<std::string> warnings_;
};

}  // namespace

void run(const CheckedScene& scene, const RunOptions& options)
{
  const int ranks_here = usable_cores(options.communicator).ranks_on_machine;
  const auto resident_at_start = static_cast<std::size_t>(resident_bytes());
  Forecast expected;
  runtime::on_first_rank(options.communicator, [&] {
    expected = forecast(scene.scene, options.communicator.size());
    expect_room(scene, expected, options.communicator.size(), ranks_here);
    add_copies(expected, options.communicator.size(), ranks_here);
    const double free = free_disk(options.folder);
    if (expected.disk > free) {
      print_err("tamp: the run writes about {} by its end, and the disk has {} free\n", in_bytes(expected.disk),
                in_bytes(free));
    }
    if (options.quiet) return;
    add_pace(scene.scene, {.part_of_run = 0.02}, expected);
    print_out("{}\n", description(expected));
    for (const std::string& line : compiled_moduli(scene)) print_out("{}\n", line);
    flush_out();
  });
  expected.in_background = options.communicator.from_first(int{expected.in_background}) != 0;
  Runner(scene, options, expected, resident_at_start).run();
}

}  // namespace tamp::tools
