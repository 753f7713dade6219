#include "tools/compare/plot_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace tamp::tools::compare
{

SiPrefix si_prefix(double magnitude)
{
  static constexpr std::array<SiPrefix, 9> prefixes{
      {{1e-12, "p"}, {1e-9, "n"}, {1e-6, "µ"}, {1e-3, "m"}, {1, ""}, {1e3, "k"}, {1e6, "M"}, {1e9, "G"}, {1e12, "T"}}};
  if (magnitude == 0) return {1, ""};
  const auto above =
      std::find_if(prefixes.begin() + 1, prefixes.end(), [&](const SiPrefix& p) { return p.factor > magnitude; });
  return *(above - 1);
}

std::string si_text(double value, std::string_view unit)
{
  // What rounds to 1000 has the next prefix already.
  const SiPrefix prefix = si_prefix(std::abs(value) * (1 + 5e-4));
  return fmt::format("{:.3g} {}{}", value / prefix.factor, prefix.symbol, unit);
}

std::vector<double> linear_ticks(double low, double high, int n_wanted)
{
  if (!(high > low)) high = low + (low != 0 ? std::abs(low) : 1);
  const double wanted = (high - low) / n_wanted;
  const double decade = std::pow(10, std::floor(std::log10(wanted)));
  double spacing = 10 * decade;
  for (const double step : {5.0, 2.0, 1.0}) {
    if (step * decade >= wanted * (1 - 1e-9)) spacing = step * decade;
  }
  // A bound that is a tick itself, but for round-off, is the last one.
  const double first = std::floor(low / spacing + 1e-9), last = std::ceil(high / spacing - 1e-9);
  std::vector<double> ticks;
  for (double k = first; k <= last; ++k) ticks.push_back(k * spacing);
  return ticks;
}

std::vector<double> log_ticks(double low, double high)
{
  high = std::max(high, 1.5 * low);
  const double decades = std::log10(high / low);
  std::vector<double> all;
  for (double e = std::floor(std::log10(low)); e <= std::ceil(std::log10(high)); ++e) {
    for (const double step : {1.0, 2.0, 5.0}) {
      if (step == 1 || decades <= 2) all.push_back(step * std::pow(10, e));
    }
  }
  const auto last = std::find_if(all.begin(), all.end(), [&](double tick) { return tick >= high * (1 - 1e-9); });
  const auto above = std::find_if(all.begin(), all.end(), [&](double tick) { return tick > low * (1 + 1e-9); });
  return {above == all.begin() ? above : above - 1, last == all.end() ? last : last + 1};
}

std::vector<PlotPoint> thinned(std::span<const PlotPoint> points, std::size_t n_wanted)
{
  if (points.size() <= n_wanted) return {points.begin(), points.end()};
  const auto by_y = [](const PlotPoint& a, const PlotPoint& b) { return a.y < b.y; };
  const std::size_t n_stretches = std::max<std::size_t>(n_wanted / 2, 1);
  std::vector<PlotPoint> kept{points.front()};
  const std::size_t n_inside = points.size() - 2;
  for (std::size_t k = 0; k < n_stretches; ++k) {
    const std::size_t begin = 1 + k * n_inside / n_stretches, end = 1 + (k + 1) * n_inside / n_stretches;
    const auto stretch = points.subspan(begin, end - begin);
    if (stretch.empty()) continue;
    const auto [lowest, highest] = std::minmax_element(stretch.begin(), stretch.end(), by_y);
    kept.push_back(*std::min(lowest, highest));
    if (lowest != highest) kept.push_back(*std::max(lowest, highest));
  }
  kept.push_back(points.back());
  return kept;
}

}  // namespace tamp::tools::compare
