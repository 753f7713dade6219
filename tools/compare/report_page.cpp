#include "tools/compare/report_page.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <functional>

#include "tools/compare/svg_plot.hpp"
#include "tools/usable_cores.hpp"
#include "tools/version.hpp"

namespace tamp::tools::compare
{

namespace
{

constexpr const char* page_style = R"(:root { color-scheme: light dark; }
body { margin: 2rem auto; max-width: 66rem; padding: 0 1rem; font: 15px/1.5 system-ui, sans-serif;
  color: #1c1c1c; background: #fff; }
h1 { font-size: 1.35rem; margin: 0; }
.lead { margin: 0.2rem 0 1.6rem; opacity: 0.75; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; border-top: 2px solid; border-bottom: 2px solid; min-width: 40rem;
  font-variant-numeric: tabular-nums; }
th, td { padding: 0.25rem 0.8rem; text-align: right; white-space: nowrap; }
th:first-child { text-align: left; font-weight: normal; }
thead th { border-bottom: 1px solid; font-weight: 600; }
.small { font-size: 0.8em; opacity: 0.75; }
.plots { display: grid; grid-template-columns: repeat(auto-fit, minmax(22rem, 1fr)); gap: 1.2rem 2rem; margin: 2rem 0; }
.notes { max-width: 46rem; font-size: 0.9rem; }
pre { font-size: 0.8rem; opacity: 0.75; overflow-x: auto; }
@media (prefers-color-scheme: dark) { body { color: #e4e4e4; background: #15171a; } }
@media print { body { margin: 0; max-width: none; } }
)";

/// A row of the table of models.
struct Row {
  const char* name;
  std::function<std::string(const ModelResult&)> cell;
};

std::string ratio_cell(const std::optional<Quartiles>& ratio)
{
  if (!ratio) return "–";
  return fmt::format(R"({:.3g} <span class="small">({:.3g}–{:.3g})</span>)", ratio->median, ratio->lower, ratio->upper);
}

std::string mebibytes(std::size_t bytes)
{
  return fmt::format("{:.1f} MiB", static_cast<double>(bytes) / (1 << 20));
}

std::vector<Row> rows(const Comparison& comparison)
{
  std::vector<Row> all{
      {"Cost of a step", [](const ModelResult& m) { return si_text(m.median_step_wall, "s"); }},
      {"Ratio to Table", [&](const ModelResult& m) { return ratio_cell(ratio_to_table(comparison, m)); }},
      {"Mean step size", [](const ModelResult& m) { return si_text(m.mean_step_size(), "s"); }},
      {"Steps", [](const ModelResult& m) { return fmt::format("{}", m.steps); }},
      {"Simulated time", [](const ModelResult& m) { return si_text(m.time, "s"); }},
      {"Time in all steps", [](const ModelResult& m) { return si_text(m.wall, "s"); }},
      {"Modulus evaluations",
       [](const ModelResult& m) { return si_text(static_cast<double>(m.modulus_evaluations), ""); }},
      {"One evaluation", [](const ModelResult& m) { return m.modulus_ns ? si_text(*m.modulus_ns * 1e-9, "s") : "–"; }},
      {"Memory, run alone", [](const ModelResult& m) { return m.peak_rss_bytes ? mebibytes(*m.peak_rss_bytes) : "–"; }},
      {"Memory, fields only", [](const ModelResult& m) { return mebibytes(m.ledger_peak_bytes); }}};
  if (!comparison.bodies.empty()) {
    all.push_back({"Greatest depth", [](const ModelResult& m) { return si_text(largest(m, &Sample::depth), "m"); }});
  }
  for (std::size_t b = 0; b < comparison.bodies.size(); ++b) {
    all.push_back({"Depth at the end", [b](const ModelResult& m) { return si_text(m.samples.back().depth[b], "m"); }});
  }
  all.push_back({"Largest p", [](const ModelResult& m) { return si_text(largest(m, &Sample::pressure), "Pa"); }});
  all.push_back({"Largest q", [](const ModelResult& m) { return si_text(largest(m, &Sample::q), "Pa"); }});
  return all;
}

std::string table_of_models(const Comparison& comparison)
{
  std::string html = "<div class=\"wide\"><table>\n<thead><tr><th></th>";
  for (const ModelResult& model : comparison.models) html += fmt::format("<th>{}</th>", escaped(model.name));
  html += "</tr></thead>\n<tbody>\n";
  for (const Row& row : rows(comparison)) {
    html += fmt::format("<tr><th>{}</th>", row.name);
    for (const ModelResult& model : comparison.models) html += fmt::format("<td>{}</td>", row.cell(model));
    html += "</tr>\n";
  }
  return html + "</tbody>\n</table></div>\n";
}

using Value = std::function<double(const Sample&)>;

/// A plot of something that every sample has; of a body or a sand that has left the domain it is not finite.
Plot over_samples(const Comparison& comparison, const std::string& title, const std::string& name,
                  const std::string& unit, const Value& value)
{
  Plot plot{title, "time", "s", name, unit, false, {}};
  for (const ModelResult& model : comparison.models) {
    PlotSeries series{model.name, {}, model.unstable()};
    for (const Sample& sample : model.samples) {
      if (std::isfinite(value(sample))) series.points.push_back({sample.time, value(sample)});
    }
    plot.series.push_back(std::move(series));
  }
  return plot;
}

/// Without the first sample, before which no step was made, and without the last one's, which had only to reach the
/// end.
Plot step_size_plot(const Comparison& comparison)
{
  Plot plot = over_samples(comparison, "Step size", "step size", "s", [](const Sample& s) { return s.step_size; });
  for (PlotSeries& series : plot.series) {
    if (!series.points.empty()) series.points.erase(series.points.begin());
    if (series.points.size() > 1 && !series.breaks_off) series.points.pop_back();
  }
  return plot;
}

Plot step_cost_plot(const Comparison& comparison)
{
  Plot plot{"Cost of a step", "time", "s", "wall time a step", "s", false, {}};
  double least = INFINITY, most = 0;
  for (const ModelResult& model : comparison.models) {
    PlotSeries series{model.name, {}, model.unstable()};
    for (const Round& round : model.rounds) {
      if (round.steps > 0) series.points.push_back({round.time, round.step_wall});
    }
    plot.series.push_back(std::move(series));
    if (model.steps == 0) continue;
    least = std::min(least, model.median_step_wall);
    most = std::max(most, model.median_step_wall);
  }
  plot.logarithmic = most > 4 * least;
  return plot;
}

std::vector<Plot> plots(const Comparison& comparison)
{
  std::vector<Plot> all{over_samples(comparison, "Wall time", "wall time", "s", [](const Sample& s) { return s.wall; }),
                        step_cost_plot(comparison), step_size_plot(comparison)};
  for (std::size_t b = 0; b < comparison.bodies.size(); ++b) {
    all.push_back(over_samples(comparison, "Depth of " + comparison.bodies[b], "depth", "m",
                               [b](const Sample& s) { return s.depth[b]; }));
  }
  for (std::size_t m = 0; m < comparison.sands.size(); ++m) {
    all.push_back(over_samples(comparison, "Largest mean stress in " + comparison.sands[m], "p", "Pa",
                               [m](const Sample& s) { return s.pressure[m]; }));
    all.push_back(over_samples(comparison, "Largest deviatoric stress in " + comparison.sands[m], "q", "Pa",
                               [m](const Sample& s) { return s.q[m]; }));
  }
  return all;
}

std::string lead(const Comparison& comparison)
{
  return fmt::format("Scene {}: {} particles, {} thread{}, {} core{}.", escaped(comparison.scene),
                     comparison.n_particles, comparison.n_threads, comparison.n_threads == 1 ? "" : "s",
                     usable_cores().of_machine, usable_cores().of_machine == 1 ? "" : "s");
}

std::string notes(const Comparison& comparison)
{
  std::string html = "<div class=\"notes\">\n";
  for (const ModelResult& model : comparison.models) {
    if (!model.unstable()) continue;
    html += fmt::format("<p><strong>{} became unstable</strong> at {}. Its lines end in a cross.</p>\n",
                        escaped(model.name), escaped(model.instability));
  }
  html += fmt::format(
      "<p>The models ran in turns, in {} rounds, each of which takes all of them through the same simulated time. "
      "<em>Cost of a step</em> is the median of a model's steps. <em>Ratio to Table</em> compares the medians within "
      "one "
      "round; its own median over the rounds, with the quartiles, is little disturbed by what else the machine "
      "did.</p>\n"
      "<p><em>One evaluation</em> of the modulus is timed on one thread over the strains and pressures that the "
      "model's own sand has at five moments of the run. <em>Memory, run alone</em> is the largest resident size of a "
      "process that makes the first steps of this model only; <em>fields only</em> counts the arrays of particles and "
      "grid over the whole run. <em>p</em> is the mean stress, compression positive, and q = √(3 J₂).</p>\n",
      comparison.models.front().rounds.size());
  return html + fmt::format("<pre>{}</pre>\n</div>\n", escaped(version_text()));
}

}  // namespace

std::string report_page(const Comparison& comparison)
{
  std::string html = fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n<title>{0}: models compared</title>\n"
      "<style>\n{1}{2}</style>\n</head>\n<body>\n<h1>{0}</h1>\n<p class=\"lead\">{3}</p>\n",
      escaped(comparison.title), page_style, plot_style(), lead(comparison));
  html += table_of_models(comparison);
  html += "<div class=\"plots\">\n";
  for (const Plot& plot : plots(comparison)) html += to_svg(plot);
  return html + "</div>\n" + notes(comparison) + "</body>\n</html>\n";
}

}  // namespace tamp::tools::compare
