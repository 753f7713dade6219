#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "runtime/storage/temporary_folder.hpp"
#include "tasks/forecast/demand.hpp"
#include "tools/bench/bench.hpp"
#include "tools/bench/particle_steps.hpp"
#include "tools/bench/peak_rate.hpp"
#include "tools/bench/triad.hpp"
#include "tools/scene/read_scene.hpp"
#include "tools/system/processor_time.hpp"
#include "tools/system/statistics.hpp"

namespace tamp::tools::bench
{

namespace
{

using Json = nlohmann::ordered_json;

constexpr std::array windows_of_run{Window{"early", 0}, Window{"middle", 0.5}, Window{"late", 0.9}};

/// Peak rates of one thread, medians of the rounds: bytes, and multiplies or adds, per second.
struct Machine {
  double bandwidth = 0;
  double arithmetic = 0;
};

struct MeasuredWindow {
  Window window;
  StepsTime time;
  double efficiency_2_threads = 0;
};

double seconds_of_step(tasks::Simulation& simulation)
{
  const double start = process_seconds();
  simulation.advance(simulation.scene().time.end);
  return process_seconds() - start;
}

/// Neighbouring steps do the same work: each recorded one is compared with the one after it, which is not.
void add_recording_ratios(tasks::Simulation& simulation, long n_steps, std::vector<double>& ratios)
{
  const double end = simulation.scene().time.end;
  for (long step = 0; step < n_steps && simulation.time() < end; step += 2) {
    simulation.engine().record(true);
    const double recorded = seconds_of_step(simulation);
    if (simulation.time() == end) return;
    simulation.engine().record(false);
    ratios.push_back(recorded / seconds_of_step(simulation));
  }
}

/// A twentieth of the run, or what takes two seconds if that is less.
long steps_of_window(const StepsTime& whole, double n_particles)
{
  constexpr long parts = 20;
  constexpr double nanoseconds = 2e9;
  const auto in_time = static_cast<long>(nanoseconds / (whole.ns * n_particles));
  return std::max(std::min(whole.n_steps / parts, in_time), 1L);
}

/// The round in the middle, by its time.
StepsTime median_of(std::vector<StepsTime> rounds)
{
  const auto middle = rounds.begin() + static_cast<std::ptrdiff_t>(rounds.size() / 2);
  std::nth_element(rounds.begin(), middle, rounds.end(),
                   [](const StepsTime& a, const StepsTime& b) { return a.ns < b.ns; });
  return *middle;
}

MeasuredWindow measured(const tasks::Scene& scene, const WindowStart& start, long n_steps, int n_rounds)
{
  std::vector<StepsTime> rounds;
  std::vector<double> one_thread, two_threads;
  for (int round = 0; round < n_rounds; ++round) {
    rounds.push_back(steps_from(scene, start, n_steps, 1));
    one_thread.push_back(rounds.back().wall);
    two_threads.push_back(steps_from(scene, start, n_steps, 2).wall);
  }
  return {start.window, median_of(std::move(rounds)), median(one_thread) / (2 * median(two_threads))};
}

double bandwidth_bound(const StepsTime& time, const Machine& machine)
{
  return time.least.bytes / machine.bandwidth * 1e9;
}

double arithmetic_bound(const StepsTime& time, const Machine& machine)
{
  return time.least.operations / machine.arithmetic * 1e9;
}

Json to_json(const StepsTime& time, const Machine& machine)
{
  Json phases = Json::array();
  for (const PhaseTime& phase : time.phases) {
    phases.push_back(
        {{"name", phase.name}, {"ns_per_particle_step", phase.ns}, {"ns_per_own_particle", phase.ns_of_own}});
  }
  const double bytes_ns = bandwidth_bound(time, machine), operations_ns = arithmetic_bound(time, machine);
  return {{"steps", time.n_steps},
          {"ns_per_particle_step", time.ns},
          {"ns_between_tasks", time.ns_between_tasks},
          {"min_bytes_per_particle_step", time.least.bytes},
          {"bound_ns", bytes_ns},
          {"ratio_to_bound", time.ns / bytes_ns},
          {"min_operations_per_particle_step", time.least.operations},
          {"arithmetic_bound_ns", operations_ns},
          {"ratio_to_arithmetic_bound", time.ns / operations_ns},
          {"phases", phases}};
}

/// Bytes of a particle of each material, and of the scene as a whole.
Json memory_of(const tasks::Scene& scene)
{
  const auto simulation = tasks::Simulation::make(scene, 1);
  Json materials = Json::array();
  for (int m = 0; m < static_cast<int>(scene.materials.size()); ++m) {
    const tasks::ParticleBytes bytes = simulation->particle_bytes(m);
    materials.push_back({{"material", scene.materials[static_cast<std::size_t>(m)].name},
                         {"state", bytes.state},
                         {"kept_state", bytes.kept_state},
                         {"all", bytes.all}});
  }
  const tasks::Demand demand = demand_of(scene);
  const auto n = static_cast<double>(demand.n_particles);
  constexpr double sixteen_gb = 16e9;
  const double fields = demand.fields / n, output = demand.output_room / n, copies = demand.checkpoint_file / n;
  return {{"of_particles", materials},
          {"with_grid", fields},
          {"with_output", fields + output},
          {"with_copies", fields + output + copies},
          {"particles_in_16_gb", sixteen_gb / (fields + output)},
          {"particles_in_16_gb_with_copies", sixteen_gb / (fields + output + copies)}};
}

using Times = std::vector<std::pair<std::string, const StepsTime*>>;

template <class ValueOf>
std::string row(const std::string& name, const Times& times, int digits, const ValueOf& value_of)
{
  std::string text = fmt::format("  {:<40}", name);
  for (const auto& [title, time] : times) text += fmt::format(" {:>9.{}f}", value_of(*time), digits);
  return text + "\n";
}

double ns_of(const StepsTime& time, const std::string& phase)
{
  const auto same = std::ranges::find(time.phases, phase, &PhaseTime::name);
  return same == time.phases.end() ? 0 : same->ns;
}

/// A column for each window and for the whole; of the phases, those that take a hundredth of the whole.
std::string table_of(const Times& times, const Machine& machine)
{
  constexpr double least_share = 0.01;
  const StepsTime& whole = *times.back().second;
  std::string text = fmt::format("  {:<40}", "nanoseconds per particle and step");
  for (const auto& [title, time] : times) text += fmt::format(" {:>9}", title);
  text += "\n" + row("all", times, 1, [](const StepsTime& time) { return time.ns; });
  for (const PhaseTime& phase : whole.phases) {
    if (phase.ns < least_share * whole.ns) continue;
    text += row("  " + phase.name, times, 1, [&](const StepsTime& time) { return ns_of(time, phase.name); });
  }
  text += row("  between tasks", times, 1, [](const StepsTime& time) { return time.ns_between_tasks; });
  text +=
      row("the memory needs at least", times, 1, [&](const StepsTime& time) { return bandwidth_bound(time, machine); });
  text += row("the arithmetic needs at least", times, 1,
              [&](const StepsTime& time) { return arithmetic_bound(time, machine); });
  text += row("bytes to move at least", times, 0, [](const StepsTime& time) { return time.least.bytes; });
  return text + row("operations at least", times, 0, [](const StepsTime& time) { return time.least.operations; });
}

std::string memory_text(const Json& memory)
{
  std::string text;
  for (const Json& of : memory["of_particles"]) {
    text += fmt::format("  bytes of a particle of {}: state {}, as it is kept {}, all arrays {}\n",
                        of["material"].get<std::string>(), of["state"].get<std::size_t>(),
                        of["kept_state"].get<std::size_t>(), of["all"].get<std::size_t>());
  }
  return text +
         fmt::format(
             "  bytes per particle with the grid {:.0f}, with output {:.0f}, with copies for the background {:.0f};\n"
             "  such scenes fit into 16 GB with {:.1f} million particles, {:.1f} with copies\n",
             memory["with_grid"].get<double>(), memory["with_output"].get<double>(),
             memory["with_copies"].get<double>(), memory["particles_in_16_gb"].get<double>() * 1e-6,
             memory["particles_in_16_gb_with_copies"].get<double>() * 1e-6);
}

/// The machine's speed is looked at before each part of the work.
class WindowBenchmark
{
 public:
  WindowBenchmark(const tasks::Scene& scene, const WindowOptions& options) : scene_(scene), options_(options) {}

  Result result(const std::string& name)
  {
    const runtime::TemporaryFolder folder;
    look_at_machine();
    whole_ = run_whole(scene_, windows_of_run, folder.path());
    n_steps_ = options_.n_steps > 0 ? options_.n_steps : steps_of_window(whole_.time, particles_of(scene_));
    for (const WindowStart& start : whole_.starts) {
      look_at_machine();
      windows_.push_back(measured(scene_, start, n_steps_, options_.n_rounds));
    }
    std::vector<double> recording;
    for (int round = 0; round < options_.n_rounds; ++round) {
      add_recording_ratios(*at_start(scene_, whole_.starts.front(), 1), n_steps_, recording);
    }
    recording_overhead_ = median(recording) - 1;
    return {json(), name + ": " + text()};
  }

 private:
  void look_at_machine()
  {
    bandwidth_.push_back(triad_bytes_per_second());
    arithmetic_.push_back(multiplies_and_adds_per_second());
  }

  /// Whether other programs had the core for so long that caches and memory were theirs, too.
  bool is_too_busy() const { return runtime::is_too_busy(whole_.time.core_share); }

  Machine machine() const { return {median(bandwidth_), median(arithmetic_)}; }

  Json json() const
  {
    Json all = to_json(whole_.time, machine());
    all["scene"] = options_.scene.filename().string();
    all["particles"] = particles_of(scene_);
    all["rounds"] = options_.n_rounds;
    all["triad_gb_per_s"] = machine().bandwidth * 1e-9;
    all["multiply_add_gop_per_s"] = machine().arithmetic * 1e-9;
    all["recording_overhead"] = recording_overhead_;
    all["core_share"] = whole_.time.core_share;
    all["too_busy"] = is_too_busy();
    all["windows"] = Json::array();
    for (const MeasuredWindow& measured : windows_) {
      Json window{{"name", measured.window.name}, {"from", measured.window.begin}};
      window.update(to_json(measured.time, machine()));
      window["efficiency_2_threads"] = measured.efficiency_2_threads;
      all["windows"].push_back(std::move(window));
    }
    all["bytes"] = memory_of(scene_);
    return all;
  }

  std::string text() const
  {
    Times times;
    for (const MeasuredWindow& measured : windows_) times.emplace_back(measured.window.name, &measured.time);
    times.emplace_back("whole", &whole_.time);
    std::string efficiencies = fmt::format("  {:<40}", "parallel efficiency of 2 threads");
    for (const MeasuredWindow& measured : windows_)
      efficiencies += fmt::format(" {:>9.3f}", measured.efficiency_2_threads);
    return fmt::format("{}, {:.0f} particles, {} steps; windows of {}, medians of {} rounds\n",
                       options_.scene.filename().string(), particles_of(scene_), whole_.time.n_steps, n_steps_,
                       options_.n_rounds) +
           table_of(times, machine()) + efficiencies +
           fmt::format(
               "\n  one thread moves {:.2f} GB/s (triad), and makes {:.1f} multiplies and adds in a nanosecond\n"
               "  recording tasks costs {:.2f} %\n",
               machine().bandwidth * 1e-9, machine().arithmetic * 1e-9, recording_overhead_ * 100) +
           (is_too_busy() ? fmt::format("  too busy to trust: other programs had this core for {:.0f} % of the time\n",
                                        100 * (1 - whole_.time.core_share))
                          : "") +
           memory_text(memory_of(scene_));
  }

  const tasks::Scene& scene_;
  const WindowOptions& options_;
  std::vector<double> bandwidth_;
  std::vector<double> arithmetic_;
  WholeRun whole_;
  long n_steps_ = 0;
  std::vector<MeasuredWindow> windows_;
  double recording_overhead_ = 0;
};

}  // namespace

Result windows(const std::string& name, const WindowOptions& options)
{
  const tasks::Scene scene = read_scene(options.scene).scene;
  return WindowBenchmark(scene, options).result(name);
}

}  // namespace tamp::tools::bench
