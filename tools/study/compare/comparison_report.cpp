#include "tools/study/compare/comparison_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "tools/scene/json/print_json.hpp"
#include "tools/scene/tables/csv_text.hpp"
#include "tools/system/usable_cores.hpp"
#include "tools/system/version.hpp"

namespace tamp::tools::compare
{

namespace
{

using Json = nlohmann::ordered_json;

Json finite_or_null(double value)
{
  return std::isfinite(value) ? Json(value) : Json(nullptr);
}

/// The figures of one model, all of them numbers or text.
Json figures(const Comparison& comparison, const ModelResult& model)
{
  const std::optional<Quartiles> ratio = ratio_to_table(comparison, model);
  Json json = {{"model", model.name},
               {"status", model.unstable() ? "unstable" : "completed"},
               {"reason", model.instability},
               {"steps", model.steps},
               {"simulated_time_s", model.time},
               {"wall_s", model.wall},
               {"wall_per_step_s", model.median_step_wall}};
  json["ratio_to_table"] = ratio ? Json(ratio->median) : Json(nullptr);
  json["ratio_to_table_lower_quartile"] = ratio ? Json(ratio->lower) : Json(nullptr);
  json["ratio_to_table_upper_quartile"] = ratio ? Json(ratio->upper) : Json(nullptr);
  json["dt_mean_s"] = model.mean_step_size();
  json["modulus_evaluations"] = model.modulus_evaluations;
  json["modulus_ns_per_eval"] = or_null(model.modulus_ns);
  json["peak_rss_bytes"] = or_null(model.peak_rss_bytes);
  json["ledger_peak_bytes"] = model.ledger_peak_bytes;
  const std::vector<double>& depth = model.samples.back().depth;
  const double common = common_time(comparison);
  json["depth_at_common_time_m"] = finite_or_null(depth_at(model, common));
  json["q_at_common_time_Pa"] = finite_or_null(q_at(model, common));
  json["depth_m"] = depth.empty() ? Json(nullptr) : Json(depth.front());
  json["depth_max_m"] = depth.empty() ? Json(nullptr) : Json(largest(model, &Sample::depth));
  json["p_max_Pa"] = largest(model, &Sample::pressure);
  json["q_max_Pa"] = largest(model, &Sample::q);
  json["state_digest"] = model.digest;
  return json;
}

Json series(const Comparison& comparison, const ModelResult& model)
{
  Json json;
  for (const Sample& sample : model.samples) {
    json["time_s"].push_back(sample.time);
    json["dt_s"].push_back(sample.step_size);
    json["wall_s"].push_back(sample.wall);
    for (std::size_t b = 0; b < comparison.bodies.size(); ++b) {
      json[comparison.bodies[b] + ".depth_m"].push_back(sample.depth[b]);
    }
    for (std::size_t m = 0; m < comparison.sands.size(); ++m) {
      json[comparison.sands[m] + ".p_max_Pa"].push_back(sample.pressure[m]);
      json[comparison.sands[m] + ".q_max_Pa"].push_back(sample.q[m]);
    }
  }
  return json;
}

Json rounds(const ModelResult& model)
{
  Json json = {{"time_s", Json::array()}, {"steps", Json::array()}, {"wall_per_step_s", Json::array()}};
  for (const Round& round : model.rounds) {
    json["time_s"].push_back(round.time);
    json["steps"].push_back(round.steps);
    json["wall_per_step_s"].push_back(round.step_wall);
  }
  return json;
}

/// Changes of one value of the first model by another model and by a coarser grid.
struct Change {
  double value;
  /// Change by cells twice as large; NaN where that is not known.
  double by_grid;

  std::string text() const
  {
    if (!std::isfinite(value)) return "-";
    const std::string words = fmt::format("{:+.2g} %", 100 * value);
    if (!std::isfinite(by_grid)) return words;
    return words + (std::abs(value) <= std::abs(by_grid) ? " (less than by the grid)" : " (more than by the grid)");
  }
};

/// All at the last time that all have reached: models that end at other times, or have failed, are at other depths.
std::string differences_text(const Comparison& comparison)
{
  if (comparison.models.size() < 2) return "";
  const double time = common_time(comparison), nan = std::numeric_limits<double>::quiet_NaN();
  const ModelResult& first = comparison.models.front();
  const auto change = [&](const ModelResult& model, double (*value)(const ModelResult&, double)) {
    return value(model, time) / value(first, time) - 1;
  };
  const double depth_by_grid = comparison.coarser ? change(*comparison.coarser, &depth_at) : nan,
               q_by_grid = comparison.coarser ? change(*comparison.coarser, &q_at) : nan;
  std::string text = fmt::format("\ndifference from {}:\n{:<16}{:<44}{}\n", first.name, "", "depth", "q");
  const auto add = [&](const std::string& name, const Change& depth, const Change& q) {
    text += fmt::format("{:<16}{:<44}{}\n", name, depth.text(), q.text());
  };
  for (auto model = comparison.models.begin() + 1; model != comparison.models.end(); ++model) {
    add(model->name, {change(*model, &depth_at), depth_by_grid}, {change(*model, &q_at), q_by_grid});
  }
  if (comparison.coarser) {
    add("2 x the cells", {depth_by_grid, nan}, {q_by_grid, nan});
  } else {
    text += "what the grid changes is not known, as cells twice as large were not run\n";
  }
  return text;
}

}  // namespace

Json to_json(const Comparison& comparison)
{
  Json json = {{"scene", comparison.scene},
               {"title", comparison.title},
               {"version", version()},
               {"program", version_text()},
               {"cores", usable_cores().of_machine},
               {"threads", comparison.n_threads},
               {"particles", comparison.n_particles},
               {"bodies", comparison.bodies},
               {"sands", comparison.sands},
               {"common_time_s", common_time(comparison)},
               {"models", Json::array()}};
  for (const ModelResult& model : comparison.models) {
    Json one = figures(comparison, model);
    one["series"] = series(comparison, model);
    one["rounds"] = rounds(model);
    json["models"].push_back(std::move(one));
  }
  json["coarser"] = nullptr;
  if (comparison.coarser) {
    const double common = common_time(comparison);
    json["coarser"] = {{"depth_at_common_time_m", finite_or_null(depth_at(*comparison.coarser, common))},
                       {"q_at_common_time_Pa", finite_or_null(q_at(*comparison.coarser, common))}};
  }
  return json;
}

std::string to_csv(const Comparison& comparison)
{
  std::vector<CsvRow> rows;
  for (const ModelResult& model : comparison.models) rows.push_back(csv_row(figures(comparison, model)));
  return csv_text(rows);
}

std::string to_text(const Comparison& comparison)
{
  std::string text = fmt::format("{:<16}{:>14}{:>10}{:>10}{:>12}{:>14}{:>11}{:>11}\n", "model", "per step [us]",
                                 "to table", "steps", "dt [us]", "modulus [ns]", "depth [m]", "q [MPa]");
  const double common = common_time(comparison);
  for (const ModelResult& model : comparison.models) {
    const std::optional<Quartiles> ratio = ratio_to_table(comparison, model);
    const double depth = depth_at(model, common);
    text += fmt::format("{:<16}{:>14.1f}{:>10}{:>10}{:>12.4g}{:>14}{:>11}{:>11.4g}{}\n", model.name,
                        model.median_step_wall * 1e6, ratio ? fmt::format("{:.2f}", ratio->median) : "-", model.steps,
                        model.mean_step_size() * 1e6, model.modulus_ns ? fmt::format("{:.1f}", *model.modulus_ns) : "-",
                        std::isfinite(depth) ? fmt::format("{:.4f}", depth) : "-", q_at(model, common) * 1e-6,
                        model.unstable() ? "  unstable" : "");
  }
  text += fmt::format("depth and q at {:.4g} ms, the last time that all have reached\n", common * 1e3);
  return text + differences_text(comparison);
}

}  // namespace tamp::tools::compare
