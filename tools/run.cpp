#include "tools/run.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "runtime/profile/report.hpp"
#include "runtime/storage/field_file.hpp"
#include "runtime/storage/whole_file.hpp"
#include "tasks/simulation.hpp"
#include "tasks/simulation_error.hpp"
#include "tools/progress.hpp"
#include "tools/run_folder.hpp"
#include "tools/run_history.hpp"
#include "tools/scene/compiled_moduli.hpp"
#include "tools/version.hpp"

namespace tamp::tools
{

namespace
{

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

std::size_t peak_rss_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

/// A moment that comes again and again: at every multiple of an interval of simulated time.
class Every
{
 public:
  explicit Every(double interval) : interval_(interval) {}
  bool due(double time)
  {
    if (time < next_) return false;
    // The tolerance keeps round-off in the sum of steps from making a moment come twice.
    while (next_ <= time * (1 + 1e-12)) next_ = interval_ * static_cast<double>(++n_);
    return true;
  }

 private:
  double interval_;
  long n_ = 0;
  double next_ = 0;
};

std::shared_ptr<runtime::Executor> executor_of(const RunOptions& options)
{
  if (options.shuffle_seed) return runtime::Executor::shuffled(*options.shuffle_seed);
  return std::make_shared<runtime::Executor>(options.n_threads);
}

class Runner
{
 public:
  Runner(const CheckedScene& checked, const RunOptions& options)
      : options_(options),
        simulation_(tasks::Simulation::make(checked.scene, executor_of(options))),
        fields_(options.folder),
        history_(*simulation_, options.folder),
        fields_moment_(checked.scene.output.fields_interval),
        history_moment_(checked.scene.output.history_interval),
        end_(std::min(checked.scene.time.end, options.until))
  {
    runtime::write_whole_file(options.folder / "scene.json", checked.resolved.dump(2) + "\n");
  }

  void run()
  {
    Progress progress(options_.quiet, end_, options_.max_steps, n_particles());
    write_due();
    while (simulation_->time() < end_ && simulation_->n_steps() < options_.max_steps) {
      const Clock::time_point begin = Clock::now();
      try {
        simulation_->advance(end_);
      } catch (const tasks::SimulationError& error) {
        progress.finish();
        fail(error);
      }
      step_seconds_.push_back(static_cast<float>(seconds_since(begin)));
      write_due();
      progress.show(simulation_->n_steps(), simulation_->time(), simulation_->last_step_size());
    }
    progress.finish();
    write_last_state();
    finish("completed", "");
  }

 private:
  std::size_t n_particles() const
  {
    std::size_t n = 0;
    for (std::size_t m = 0; m < simulation_->scene().materials.size(); ++m) {
      n += simulation_->n_particles(static_cast<int>(m));
    }
    return n;
  }

  void write_due()
  {
    if (history_moment_.due(simulation_->time())) write_history();
    if (fields_moment_.due(simulation_->time())) write_fields();
  }

  void write_history()
  {
    history_.write_row();
    history_step_ = simulation_->n_steps();
  }

  void write_fields()
  {
    const auto particles = simulation_->particle_columns();
    fields_.write_step(simulation_->n_steps(), simulation_->time(), particles, simulation_->node_columns());
    fields_step_ = simulation_->n_steps();
  }

  void write_last_state()
  {
    if (history_step_ != simulation_->n_steps()) write_history();
    if (fields_step_ != simulation_->n_steps()) write_fields();
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
    const runtime::Profile profile = simulation_->profile();
    const nlohmann::json json = to_json(profile, simulation_->ledger());
    runtime::write_whole_file(options_.folder / "profile.json", json.dump(1) + "\n");
    runtime::write_whole_file(options_.folder / "trace.json", runtime::trace_to_json(profile).dump() + "\n");
    const nlohmann::ordered_json told = summary(status, reason);
    runtime::write_whole_file(options_.folder / "summary.json", told.dump(2) + "\n");
    if (options_.quiet) return;
    fmt::print("{}\n", runtime::to_text(json, 10));
    print_summary(told);
  }

  nlohmann::ordered_json summary(const std::string& status, const std::string& reason)
  {
    const tasks::Scene& scene = simulation_->scene();
    const double wall = seconds_since(start_);
    nlohmann::ordered_json particles = {{"total", n_particles()}};
    for (std::size_t m = 0; m < scene.materials.size(); ++m) {
      particles[scene.materials[m].name] = simulation_->n_particles(static_cast<int>(m));
    }
    particles["lost"] = simulation_->lost().count;
    particles["lost_mass_kg"] = simulation_->lost().mass;
    const double step_seconds = median_step_seconds();
    const std::size_t rss = peak_rss_bytes();
    const EnergyBalance& e = history_.energies();
    const components::UpdateCounts& updates = simulation_->totals().updates;
    return {{"status", status},
            {"reason", reason},
            {"scene", scene.name},
            {"version", version()},
            {"ranks", 1},
            {"threads", simulation_->n_threads()},
            {"patches", scene.n_patches[0] * scene.n_patches[1] * scene.n_patches[2]},
            {"particles", particles},
            {"steps", simulation_->n_steps()},
            {"simulated_time_s", simulation_->time()},
            {"wall_s", wall},
            {"wall_per_step_s", step_seconds},
            {"particle_updates_per_s", step_seconds > 0 ? static_cast<double>(n_particles()) / step_seconds : 0},
            {"peak_rss_bytes", {{"sum", rss}, {"max", rss}}},
            {"forecast_peak_bytes", simulation_->forecast_bytes()},
            {"ledger_peak_bytes", simulation_->ledger().total().peak()},
            {"energy_error", history_.energy_error()},
            {"momentum_error", history_.momentum_error()},
            {"energies_J",
             {{"kinetic", e.kinetic},
              {"elastic", e.elastic},
              {"plastic", e.plastic},
              {"viscous", e.viscous},
              {"contact", e.contact},
              {"external", e.external},
              {"total", e.total}}},
            {"state_digest", simulation_->digest()},
            {"bodies", bodies()},
            {"materials", materials()},
            {"monitors",
             {{"lost_particles", simulation_->lost().count},
              {"substeps", updates.substeps},
              {"split_updates", updates.split_updates},
              {"limited_substeps", updates.limited_substeps},
              {"modulus_evaluations", updates.modulus_evaluations},
              {"modulus_extrapolations", updates.extrapolated},
              {"failed_updates", updates.failures}}}};
  }

  nlohmann::ordered_json bodies() const
  {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    for (const std::size_t b : history_.tracked_bodies()) {
      const tasks::BodySums& sums = history_.report().bodies[b];
      const Eigen::Vector3d v = sums.momentum / sums.mass;
      all[simulation_->scene().bodies[b].name] = {
          {"mass_kg", sums.mass}, {"depth_m", history_.depth(b)}, {"velocity_m_per_s", {v[0], v[1], v[2]}}};
    }
    return all;
  }

  nlohmann::ordered_json materials() const
  {
    nlohmann::ordered_json all = nlohmann::ordered_json::object();
    for (std::size_t m = 0; m < simulation_->scene().materials.size(); ++m) {
      const tasks::MaterialPeaks& peaks = history_.report().materials[m];
      all[simulation_->scene().materials[m].name] = {{"p_max_Pa", peaks.pressure}, {"q_max_Pa", peaks.q}};
    }
    return all;
  }

  double median_step_seconds()
  {
    if (step_seconds_.empty()) return 0;
    const auto middle = step_seconds_.begin() + static_cast<std::ptrdiff_t>(step_seconds_.size() / 2);
    std::nth_element(step_seconds_.begin(), middle, step_seconds_.end());
    return *middle;
  }

  void print_summary(const nlohmann::ordered_json& told) const
  {
    fmt::print("{}: {} after {} steps, {:.6g} s simulated in {:.1f} s\n", told["scene"].get<std::string>(),
               told["status"].get<std::string>(), simulation_->n_steps(), simulation_->time(),
               told["wall_s"].get<double>());
    for (const std::size_t b : history_.tracked_bodies()) {
      const tasks::BodySums& sums = history_.report().bodies[b];
      fmt::print("  {}: depth {:.4f} m, speed {:.3f} m/s\n", simulation_->scene().bodies[b].name, history_.depth(b),
                 (sums.momentum / sums.mass).norm());
    }
    fmt::print("  energy error {:.3g}, momentum error {:.3g}, {} particles lost, state digest {}\n",
               history_.energy_error(), history_.momentum_error(), simulation_->lost().count,
               told["state_digest"].get<std::string>());
    const components::UpdateCounts& updates = simulation_->totals().updates;
    if (updates.extrapolated + updates.limited_substeps + updates.failures > 0) {
      fmt::print(
          "  of {} sand substeps {} kept an error beyond the tolerance; {} updates ended outside the modulus' "
          "range, {} failed\n",
          updates.substeps, updates.limited_substeps, updates.extrapolated, updates.failures);
    }
    fmt::print("  written to {}\n", options_.folder.string());
  }

  const RunOptions& options_;
  Clock::time_point start_ = Clock::now();
  std::unique_ptr<tasks::Simulation> simulation_;
  runtime::FieldFile fields_;
  RunHistory history_;
  Every fields_moment_;
  Every history_moment_;
  double end_;
  long history_step_ = -1;
  long fields_step_ = -1;
  std::vector<float> step_seconds_;
};

}  // namespace

void run(const CheckedScene& scene, const RunOptions& options)
{
  prepare_run_folder(options.folder, options.force);
  if (!options.quiet) {
    for (const std::string& line : compiled_moduli(scene)) fmt::print("{}\n", line);
  }
  Runner(scene, options).run();
}

}  // namespace tamp::tools
