#include "tools/run/run_summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>

#include "tools/version.hpp"

namespace tamp::tools
{

namespace
{

using Json = nlohmann::ordered_json;

struct OverRanks {
  std::size_t sum;
  std::size_t max;
};

OverRanks over_ranks(const tasks::Simulation& simulation, std::size_t own)
{
  return {simulation.communicator().sum(own), simulation.communicator().max(own)};
}

std::size_t peak_rss_bytes()
{
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<std::size_t>(usage.ru_maxrss) * 1024;
}

Json particles(const tasks::Simulation& simulation, const tasks::LostParticles& lost)
{
  const auto& scene_materials = simulation.scene().materials;
  Json counts = {{"total", 0}};
  std::size_t total = 0;
  for (std::size_t m = 0; m < scene_materials.size(); ++m) {
    const std::size_t n = simulation.n_particles(static_cast<int>(m));
    counts[scene_materials[m].name] = n;
    total += n;
  }
  counts["total"] = total;
  counts["lost"] = lost.count;
  counts["lost_mass_kg"] = lost.mass;
  return counts;
}

Json bodies(const tasks::Simulation& simulation, const RunHistory& history)
{
  Json all = Json::object();
  for (const std::size_t b : history.tracked_bodies()) {
    const tasks::BodySums& sums = history.report().bodies[b];
    const Eigen::Vector3d v = sums.momentum / sums.mass;
    all[simulation.scene().bodies[b].name] = {
        {"mass_kg", sums.mass}, {"depth_m", history.depth(b)}, {"velocity_m_per_s", {v[0], v[1], v[2]}}};
  }
  return all;
}

Json materials(const tasks::Simulation& simulation, const RunHistory& history)
{
  Json all = Json::object();
  for (std::size_t m = 0; m < simulation.scene().materials.size(); ++m) {
    const tasks::MaterialPeaks& peaks = history.report().materials[m];
    all[simulation.scene().materials[m].name] = {{"p_max_Pa", peaks.pressure}, {"q_max_Pa", peaks.q}};
  }
  return all;
}

Json to_json(const Forecast& forecast)
{
  Json json{{"memory_bytes", forecast.memory}, {"disk_bytes", forecast.disk}};
  json["steps"] = forecast.pace ? Json(forecast.pace->n_steps) : Json(nullptr);
  json["core_seconds"] = forecast.pace ? Json(forecast.pace->core_seconds) : Json(nullptr);
  return json;
}

Json output(const RunOutcome& outcome)
{
  const OutputTime& time = outcome.output;
  return {{"in_background", outcome.in_background},
          {"history_s", time.history},
          {"fields_s", time.fields},
          {"checkpoints_s", time.checkpoints},
          {"waited_s", time.waited}};
}

Json rebalances(const tasks::Simulation& simulation)
{
  Json all = Json::array();
  for (const tasks::Rebalance& r : simulation.rebalances()) {
    all.push_back({{"step", r.step},
                   {"imbalance_before", r.imbalance_before},
                   {"imbalance_expected", r.imbalance_expected},
                   {"imbalance_got", r.imbalance_got}});
  }
  return all;
}

}  // namespace

Json run_summary(tasks::Simulation& simulation, const RunHistory& history, const RunOutcome& outcome)
{
  const tasks::Scene& scene = simulation.scene();
  const tasks::LostParticles lost = simulation.lost();
  const Json counts = particles(simulation, lost);
  const OverRanks rss = over_ranks(simulation, peak_rss_bytes());
  const OverRanks ledger = over_ranks(simulation, static_cast<std::size_t>(simulation.ledger().total().peak()));
  const EnergyBalance& e = history.energies();
  const components::UpdateCounts& updates = simulation.updates();
  const double n_total = counts["total"].get<double>();
  return {{"status", outcome.status},
          {"reason", outcome.reason},
          {"warnings", outcome.warnings},
          {"scene", scene.name},
          {"version", version()},
          {"ranks", simulation.communicator().size()},
          {"threads", simulation.n_threads()},
          {"patches", scene.n_patches[0] * scene.n_patches[1] * scene.n_patches[2]},
          {"particles", counts},
          {"steps", simulation.n_steps()},
          {"restarted_at_step", outcome.restarted_at < 0 ? Json(nullptr) : Json(outcome.restarted_at)},
          {"simulated_time_s", simulation.time()},
          {"wall_s", outcome.wall},
          {"wall_per_step_s", outcome.wall_per_step},
          {"particle_updates_per_s", outcome.wall_per_step > 0 ? n_total / outcome.wall_per_step : 0},
          {"output", output(outcome)},
          {"peak_rss_bytes", {{"sum", rss.sum}, {"max", rss.max}}},
          {"forecast_peak_bytes", simulation.forecast_bytes()},
          {"ledger_peak_bytes", ledger.sum},
          {"energy_error", history.energy_error()},
          {"momentum_error", history.momentum_error()},
          {"energies_J",
           {{"kinetic", e.kinetic},
            {"elastic", e.elastic},
            {"plastic", e.plastic},
            {"viscous", e.viscous},
            {"contact", e.contact},
            {"filter", e.filter},
            {"half_step", e.half_step},
            {"external", e.external},
            {"total", e.total}}},
          {"forecast", to_json(outcome.forecast)},
          {"inputs", to_json(outcome.inputs)},
          {"state_digest", simulation.digest()},
          {"bodies", bodies(simulation, history)},
          {"materials", materials(simulation, history)},
          {"load_balance", rebalances(simulation)},
          {"monitors",
           {{"lost_particles", lost.count},
            {"substeps", updates.substeps},
            {"split_updates", updates.split_updates},
            {"limited_substeps", updates.limited_substeps},
            {"modulus_evaluations", updates.modulus_evaluations},
            {"modulus_extrapolations", updates.extrapolated},
            {"failed_updates", updates.failures},
            {"separations", updates.separations},
            {"updates_apart", updates.apart}}}};
}

std::string summary_text(const Json& summary)
{
  std::string text =
      fmt::format("{}: {} after {} steps, {:.6g} s simulated in {:.1f} s\n", summary["scene"].get<std::string>(),
                  summary["status"].get<std::string>(), summary["steps"].get<long>(),
                  summary["simulated_time_s"].get<double>(), summary["wall_s"].get<double>());
  for (const auto& [name, body] : summary["bodies"].items()) {
    const auto v = body["velocity_m_per_s"].get<std::vector<double>>();
    text += fmt::format("  {}: depth {:.4f} m, speed {:.3f} m/s\n", name, body["depth_m"].get<double>(),
                        std::hypot(v[0], v[1], v[2]));
  }
  for (const Json& r : summary["load_balance"]) {
    const auto got = r["imbalance_got"].get<double>();
    text += fmt::format("  step {}: patches dealt anew; the busiest rank had {:.2f} of the mean, {:.2f} expected{}\n",
                        r["step"].get<long>(), r["imbalance_before"].get<double>(),
                        r["imbalance_expected"].get<double>(), got > 0 ? fmt::format(", {:.2f} got", got) : "");
  }
  const Json& output = summary["output"];
  const auto seconds = [&](const char* name) { return output[name].get<double>(); };
  text += fmt::format("  for output the steps stood still for {:.2g} s, {:.2g} s of it for the writer\n",
                      seconds("history_s") + seconds("fields_s") + seconds("checkpoints_s") + seconds("waited_s"),
                      seconds("waited_s"));
  text += fmt::format(
      "  energy error {:.3g}, {:.3g} J filtered out, momentum error {:.3g}, {} particles lost, state digest {}\n",
      summary["energy_error"].get<double>(), summary["energies_J"]["filter"].get<double>(),
      summary["momentum_error"].get<double>(), summary["particles"]["lost"].get<std::size_t>(),
      summary["state_digest"].get<std::string>());
  const Json& monitors = summary["monitors"];
  const auto count = [&](const char* name) { return monitors[name].get<std::size_t>(); };
  if (count("modulus_extrapolations") + count("limited_substeps") + count("failed_updates") > 0) {
    text += fmt::format(
        "  of {} substeps of materials {} kept an error beyond the tolerance; {} updates ended outside the modulus' "
        "range, {} "
        "failed\n",
        count("substeps"), count("limited_substeps"), count("modulus_extrapolations"), count("failed_updates"));
  }
  return text;
}

}  // namespace tamp::tools
