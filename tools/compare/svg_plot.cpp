#include "tools/compare/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace tamp::tools::compare
{

namespace
{

constexpr double width = 480, height = 320;
constexpr double left = 58, right = width - 16, bottom = height - 46;
constexpr double legend_row = 18;
constexpr std::size_t most_points = 400;
constexpr std::size_t n_styles = 6;

/// From values to places along one axis.
struct Axis {
  std::vector<double> ticks;
  bool logarithmic;
  double low, high;  // the values at its ends
  double from, to;   // the ends in the picture

  double operator()(double value) const
  {
    return from + (along(value) - along(low)) / (along(high) - along(low)) * (to - from);
  }
  double along(double value) const { return logarithmic ? std::log10(value) : value; }
};

struct Range {
  double low, high;
};

Range range_of(const Plot& plot, double PlotPoint::*coordinate)
{
  Range range{INFINITY, -INFINITY};
  for (const PlotSeries& series : plot.series) {
    for (const PlotPoint& point : series.points) {
      range.low = std::min(range.low, point.*coordinate);
      range.high = std::max(range.high, point.*coordinate);
    }
  }
  return range.low <= range.high ? range : Range{1, 2};
}

Axis x_axis(const Plot& plot)
{
  const Range range = range_of(plot, &PlotPoint::x);
  // Time ends where the run does, which need not be a round number.
  std::vector<double> ticks = linear_ticks(0, range.high, 6);
  if (ticks.back() > range.high * (1 + 1e-9)) ticks.pop_back();
  return {ticks, false, 0, std::max(range.high, ticks.back()), left, right};
}

Axis y_axis(const Plot& plot, double top)
{
  const Range range = range_of(plot, &PlotPoint::y);
  // Zero belongs to the picture unless that would flatten what there is to see.
  const double low = range.low > 0 && range.low < 0.7 * range.high ? 0 : range.low;
  const auto ticks = plot.logarithmic ? log_ticks(range.low, range.high) : linear_ticks(low, range.high, 5);
  return {ticks, plot.logarithmic, ticks.front(), ticks.back(), bottom, top};
}

class Drawing
{
 public:
  explicit Drawing(const Plot& plot)
      : plot_(plot),
        top_(30 + legend_row * static_cast<double>(n_legend_rows())),
        x_(x_axis(plot)),
        y_(y_axis(plot, top_))
  {
  }

  std::string draw()
  {
    add(R"(<svg class="plot" viewBox="0 0 {} {}" role="img" aria-label="{}">)", width, height, escaped(plot_.title));
    text(left, 16, "title", plot_.title);
    legend();
    axes();
    for (std::size_t s = 0; s < plot_.series.size(); ++s) line(s);
    svg_ += "</svg>\n";
    return std::move(svg_);
  }

 private:
  template <class... Values>
  void add(fmt::format_string<Values...> format, Values&&... values)
  {
    fmt::format_to(std::back_inserter(svg_), format, std::forward<Values>(values)...);
  }

  void text(double x, double y, const char* kind, const std::string& words)
  {
    add(R"(<text class="{}" x="{:.1f}" y="{:.1f}">{}</text>)", kind, x, y, escaped(words));
  }

  static double entry_width(const PlotSeries& series) { return 46 + 6.6 * static_cast<double>(series.name.size()); }

  std::size_t n_legend_rows() const
  {
    double x = left;
    std::size_t rows = 1;
    for (const PlotSeries& series : plot_.series) {
      if (x > left && x + entry_width(series) > right) x = left, ++rows;
      x += entry_width(series);
    }
    return rows;
  }

  void legend()
  {
    double x = left, y = 34;
    for (std::size_t s = 0; s < plot_.series.size(); ++s) {
      const PlotSeries& series = plot_.series[s];
      if (x > left && x + entry_width(series) > right) x = left, y += legend_row;
      add(R"(<path class="line s{}" d="M{:.1f} {:.1f}h28"/>)", s % n_styles, x, y - 4);
      text(x + 33, y, "name", series.name);
      x += entry_width(series);
    }
  }

  void axes()
  {
    const SiPrefix x_prefix = si_prefix(x_.ticks.back());
    const SiPrefix y_prefix = si_prefix(std::max(std::abs(y_.ticks.front()), std::abs(y_.ticks.back())));
    for (const double tick : y_.ticks) {
      add(R"(<path class="grid" d="M{} {:.1f}H{}"/>)", left, y_(tick), right);
      text(left - 7, y_(tick) + 4, "y tick", fmt::format("{:g}", tick / y_prefix.factor));
    }
    for (const double tick : x_.ticks) {
      add(R"(<path class="axis" d="M{:.1f} {}v4"/>)", x_(tick), bottom);
      text(x_(tick), bottom + 18, "x tick", fmt::format("{:g}", tick / x_prefix.factor));
    }
    add(R"(<path class="axis" d="M{} {:.1f}V{}H{}"/>)", left, top_, bottom, right);
    text((left + right) / 2, height - 8, "x label", labelled(plot_.x_name, x_prefix, plot_.x_unit));
    const double middle = (top_ + bottom) / 2;
    add(R"svg(<text class="y label" transform="translate(14 {:.1f}) rotate(-90)">{}</text>)svg", middle,
        escaped(labelled(plot_.y_name, y_prefix, plot_.y_unit)));
  }

  static std::string labelled(const std::string& name, const SiPrefix& prefix, const std::string& unit)
  {
    return fmt::format("{} [{}{}]", name, prefix.symbol, unit);
  }

  void line(std::size_t s)
  {
    const PlotSeries& series = plot_.series[s];
    if (series.points.empty()) return;
    add(R"(<polyline class="line s{}" points=")", s % n_styles);
    for (const PlotPoint& point : thinned(series.points, most_points)) add("{:.1f},{:.1f} ", x_(point.x), y_(point.y));
    svg_ += "\"/>";
    if (!series.breaks_off) return;
    const PlotPoint& end = series.points.back();
    add(R"(<path class="cross s{}" d="M{:.1f} {:.1f}m-5 -5l10 10m0 -10l-10 10"/>)", s % n_styles, x_(end.x), y_(end.y));
  }

  const Plot& plot_;
  double top_;
  Axis x_, y_;
  std::string svg_;
};

}  // namespace

std::string to_svg(const Plot& plot)
{
  return Drawing(plot).draw();
}

std::string plot_style()
{
  return R"(:root { --s0: #1b4f9c; --s1: #d4600f; --s2: #23835a; --s3: #8d3fa6; --s4: #666; --s5: #a87b00; }
@media (prefers-color-scheme: dark) {
  :root { --s0: #86b4ff; --s1: #ffa765; --s2: #6fd3a3; --s3: #d9a0f0; --s4: #b4b4b4; --s5: #e6c455; }
}
.plot { width: 100%; height: auto; font: 12px system-ui, sans-serif; }
.plot text { fill: currentColor; }
.plot .title { font-weight: 600; font-size: 13px; }
.plot .x { text-anchor: middle; }
.plot .y.tick { text-anchor: end; }
.plot .y.label { text-anchor: middle; }
.plot .tick { font-size: 11px; }
.plot .axis { fill: none; stroke: currentColor; }
.plot .grid { stroke: currentColor; opacity: 0.13; }
.plot .line, .plot .cross { fill: none; stroke-width: 1.6; stroke-linejoin: round; }
.plot .s0 { stroke: var(--s0); }
.plot .s1 { stroke: var(--s1); }
.plot .s2 { stroke: var(--s2); }
.plot .s3 { stroke: var(--s3); }
.plot .s4 { stroke: var(--s4); }
.plot .s5 { stroke: var(--s5); }
.plot .line.s1 { stroke-dasharray: 8 3; }
.plot .line.s2 { stroke-dasharray: 2 2.5; stroke-width: 2; }
.plot .line.s3 { stroke-dasharray: 10 3 2 3; }
.plot .line.s4 { stroke-dasharray: 4 2; }
.plot .line.s5 { stroke-dasharray: 14 3 2 3 2 3; }
)";
}

std::string escaped(const std::string& text)
{
  std::string safe;
  for (const char c : text) {
    switch (c) {
      case '&':
        safe += "&amp;";
        break;
      case '<':
        safe += "&lt;";
        break;
      case '>':
        safe += "&gt;";
        break;
      case '"':
        safe += "&quot;";
        break;
      case '\'':
        safe += "&#39;";
        break;
      default:
        safe += c;
    }
  }
  return safe;
}

}  // namespace tamp::tools::compare
