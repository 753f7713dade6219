#include "tools/run/run_summary.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tools/advice/penetration.hpp"
#include "tools/run/monitors.hpp"
#include "tools/run/step_summary.hpp"
#include "tools/scene/bodies/symmetry.hpp"
#include "tools/system/version.hpp"

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

/// The component of the force on a driven body that was largest, with its sign, and the same now.
Json largest_force(const RunHistory& history, const std::string& body, int dimension, const Eigen::Vector3d& now)
{
  Json largest;
  double most = 0;
  for (int k = 0; k < dimension; ++k) {
    const std::string axis(1, "xyz"[k]);
    const auto found = history.extremes().find(fmt::format("{}.contact_force_{}[N]", body, axis));
    if (found == history.extremes().end()) continue;
    const Extremes& e = found->second;
    const bool upwards = std::abs(e.greatest) >= std::abs(e.least);
    const double value = upwards ? e.greatest : e.least;
    if (!(std::abs(value) > most)) continue;
    most = std::abs(value);
    largest = {
        {"axis", axis}, {"value_N", value}, {"time_s", upwards ? e.greatest_time : e.least_time}, {"now_N", now[k]}};
  }
  return largest;
}

Json bodies(const tasks::Simulation& simulation, const RunHistory& history)
{
  Json all = Json::object();
  for (const std::size_t b : history.tracked_bodies()) {
    const tasks::SceneBody& body = simulation.scene().bodies[b];
    const tasks::BodySums& sums = history.report().bodies[b];
    const Eigen::Vector3d v = sums.momentum / sums.mass;
    Json& entry = all[body.name] = {
        {"mass_kg", sums.mass}, {"depth_m", history.depth(b)}, {"velocity_m_per_s", {v[0], v[1], v[2]}}};
    if (const auto depth = history.extremes().find(body.name + ".depth[m]"); depth != history.extremes().end()) {
      entry["deepest_m"] = depth->second.greatest;
      entry["deepest_at_s"] = depth->second.greatest_time;
    }
    if (const auto penetration = penetration_of(simulation.scene(), body)) {
      entry["into"] = penetration->into->name;
      entry["cells_to_half_width"] = penetration->cells();
    }
    if (!body.drive) continue;
    entry["largest_force"] =
        largest_force(history, body.name, simulation.scene().grid.dimension, history.contact_force(b));
  }
  return all;
}

/// The greatest value of each column but step and time.
Json greatest(const RunHistory& history)
{
  Json all = Json::object();
  for (const auto& [name, e] : history.extremes()) {
    if (name != "step" && name != "time[s]") all[name] = {{"value", e.greatest}, {"time_s", e.greatest_time}};
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

/// The part of the whole that the scene is, by its planes of symmetry.
Json part_of_whole(const tasks::Scene& scene)
{
  const tasks::Sides faces = planes_of_symmetry(scene);
  int factor = 1;
  Json planes = Json::array();
  for (std::size_t axis = 0; axis < 3; ++axis) {
    for (std::size_t side = 0; side < 2; ++side) {
      if (!faces[axis][side]) continue;
      factor *= 2;
      planes.push_back(fmt::format("{}{}", "xyz"[axis], "-+"[side]));
    }
  }
  return {{"factor", factor}, {"planes", planes}};
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
  for (const runtime::Rebalance& r : simulation.engine().rebalances()) {
    all.push_back({{"step", r.step},
                   {"imbalance_before", r.imbalance_before},
                   {"imbalance_expected", r.imbalance_expected},
                   {"imbalance_got", r.imbalance_got}});
  }
  return all;
}

/// The monitors with limits, the worst first, then those that only count.
Json monitors(const tasks::Simulation& simulation, const RunHistory& history, const ForecastMiss& missed)
{
  Json all;
  for (const Monitor& monitor : monitors_of(simulation, history, missed)) {
    all[monitor.name] = to_json(monitor, simulation.scene());
  }
  const components::UpdateCounts& updates = simulation.updates();
  const Json counts{{"lost_particles", simulation.lost().count},
                    {"substeps", updates.substeps},
                    {"split_updates", updates.split_updates},
                    {"limited_substeps", updates.limited_substeps},
                    {"modulus_evaluations", updates.modulus_evaluations},
                    {"modulus_extrapolations", updates.extrapolated},
                    {"modulus_extrapolations_in_tension", updates.pulled_out},
                    {"modulus_extrapolations_looser", updates.looser},
                    {"failed_updates", updates.failures},
                    {"separations", updates.separations},
                    {"updates_apart", updates.apart}};
  all.update(counts);
  return all;
}

}  // namespace

Json run_summary(tasks::Simulation& simulation, const RunHistory& history, const RunOutcome& outcome)
{
  const tasks::Scene& scene = simulation.scene();
  const tasks::LostParticles lost = simulation.lost();
  const Json counts = particles(simulation, lost);
  const OverRanks rss = over_ranks(simulation, peak_rss_bytes());
  const std::size_t growth = simulation.communicator().sum(peak_rss_bytes() - outcome.resident_at_start);
  const OverRanks ledger =
      over_ranks(simulation, static_cast<std::size_t>(simulation.engine().warehouse().ledger().total().peak()));
  const EnergyBalance& e = history.energies();
  const double n_total = counts["total"].get<double>();
  const auto n_steps = static_cast<double>(simulation.n_steps() - std::max(outcome.restarted_at, 0L));
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
          {"time_step", step_summary(simulation)},
          {"wall_s", outcome.wall},
          {"wall_per_step_s", outcome.wall_per_step},
          {"wall_parts_s",
           {{"set_up", outcome.parts.set_up},
            {"steps", outcome.parts.steps},
            {"output", outcome.parts.output},
            {"end", outcome.parts.end}}},
          {"particle_updates_per_s", outcome.parts.steps > 0 ? n_total * n_steps / outcome.parts.steps : 0},
          {"output", output(outcome)},
          {"peak_rss_bytes", {{"sum", rss.sum}, {"max", rss.max}}},
          {"forecast_peak_bytes", simulation.forecast_bytes()},
          {"ledger_peak_bytes", ledger.sum},
          {"memory",
           {{"forecast_bytes", outcome.forecast.memory - outcome.forecast.at_start},
            {"ledger_bytes", ledger.sum},
            {"process_bytes", growth}}},
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
          {"left_out", outcome.left_out},
          {"state_digest", simulation.digest()},
          {"part_of_whole", part_of_whole(simulation.scene())},
          {"bodies", bodies(simulation, history)},
          {"materials", materials(simulation, history)},
          {"greatest", greatest(history)},
          {"load_balance", rebalances(simulation)},
          {"monitors", monitors(simulation, history, outcome.missed)}};
}

namespace
{

/// A time as people say it: "1.8 ms".
std::string in_words(double seconds)
{
  if (seconds == 0 || std::abs(seconds) >= 1) return fmt::format("{:.4g} s", seconds);
  return std::abs(seconds) >= 1e-3 ? fmt::format("{:.4g} ms", seconds * 1e3) : fmt::format("{:.4g} us", seconds * 1e6);
}

/// A line on the scene's subject: the depth of a body, or the force that drives it.
std::string body_text(const std::string& name, const Json& body)
{
  const auto number = [&](const char* key) { return body[key].get<double>(); };
  const auto v = body["velocity_m_per_s"].get<std::vector<double>>();
  std::string text = fmt::format("{}: ", name);
  if (body.contains("deepest_m")) {
    text += fmt::format("deepest {:.4g} m at {}, now {:.4g} m", number("deepest_m"), in_words(number("deepest_at_s")),
                        number("depth_m"));
  } else {
    text += fmt::format("depth {:.4g} m", number("depth_m"));
  }
  text += fmt::format(", {:.4g} m/s", std::hypot(v[0], v[1], v[2]));
  if (body.contains("largest_force") && !body["largest_force"].is_null()) {
    const Json& force = body["largest_force"];
    text += fmt::format("; force along {} at most {:.4g} N at {}, now {:.4g} N (means over the history interval)",
                        force["axis"].get<std::string>(), force["value_N"].get<double>(),
                        in_words(force["time_s"].get<double>()), force["now_N"].get<double>());
  }
  return text + "\n";
}

/// A line on how far the worst of the monitors is from its limit.
std::string monitors_text(const Json& monitors)
{
  std::string text = "  closest to their limits:";
  int n_shown = 0;
  for (const auto& [name, monitor] : monitors.items()) {
    if (!monitor.is_object() || n_shown++ == 4) break;
    text += fmt::format("{} {} {:.2g} of {:.2g}", n_shown > 1 ? "," : "", name, monitor["share"].get<double>(),
                        monitor["limit"].get<double>());
  }
  return text + "\n";
}

}  // namespace

std::string summary_text(const Json& summary)
{
  std::string text;
  for (const auto& [name, body] : summary["bodies"].items()) text += body_text(name, body);
  text += fmt::format("{}: {} after {} steps, {} simulated in {:.1f} s\n", summary["scene"].get<std::string>(),
                      summary["status"].get<std::string>(), summary["steps"].get<long>(),
                      in_words(summary["simulated_time_s"].get<double>()), summary["wall_s"].get<double>());
  for (const Json& r : summary["load_balance"]) {
    const auto got = r["imbalance_got"].get<double>();
    text += fmt::format(
        "  step {}: patches dealt anew; load of the busiest rank over the mean: {:.2f} before, {:.2f} expected{}\n",
        r["step"].get<long>(), r["imbalance_before"].get<double>(), r["imbalance_expected"].get<double>(),
        got > 0 ? fmt::format(", {:.2f} measured", got) : "");
  }
  const Json& output = summary["output"];
  const auto seconds = [&](const char* name) { return output[name].get<double>(); };
  text += fmt::format("  output delayed the steps by {:.2g} s, {:.2g} s of it waiting for the writer\n",
                      seconds("history_s") + seconds("fields_s") + seconds("checkpoints_s") + seconds("waited_s"),
                      seconds("waited_s"));
  text += fmt::format(
      "  energy error {:.3g}, {:.3g} J lost in the transfer, momentum error {:.3g}, {} particles lost, state digest "
      "{}\n",
      summary["energy_error"].get<double>(), summary["energies_J"]["filter"].get<double>(),
      summary["momentum_error"].get<double>(), summary["particles"]["lost"].get<std::size_t>(),
      summary["state_digest"].get<std::string>());
  return text + monitors_text(summary["monitors"]);
}

}  // namespace tamp::tools
