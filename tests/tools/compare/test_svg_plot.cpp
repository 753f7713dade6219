#include <catch2/catch.hpp>

#include "tools/compare/svg_plot.hpp"

using namespace tamp::tools::compare;
using Catch::Contains;

namespace
{

Plot example()
{
  return {"Depth of punch", "time", "s", "depth", "m", false, {{"table", {{0, 0}, {1e-3, 0.2}, {2e-3, 0.4}}, false}}};
}

}  // namespace

TEST_CASE("a plot names its axes with units and prefixes, and its series")
{
  const std::string svg = to_svg(example());

  CHECK_THAT(svg, Contains("Depth of punch") && Contains("time [ms]") && Contains("depth [mm]") && Contains(">table<"));
}

TEST_CASE("points stand where the ticks put them")
{
  const std::string svg = to_svg(example());

  // From 0 to 2 ms over 58 to 464, and 0 to 0.4 m over 274 up to 48.
  CHECK_THAT(svg, Contains("points=\"58.0,274.0 261.0,161.0 464.0,48.0 \""));
}

TEST_CASE("the picture ends where the points do, between two ticks too")
{
  Plot plot = example();
  plot.series[0].points = {{0, 0}, {3.5e-3, 0.2}, {7e-3, 0.4}};

  const std::string svg = to_svg(plot);

  CHECK_THAT(svg, Contains("464.0,48.0 ") && Contains(">6<") && !Contains(">8<"));
}

TEST_CASE("on a logarithmic axis equal ratios are equal distances")
{
  Plot plot = example();
  plot.logarithmic = true;
  plot.series[0].points = {{0, 1}, {1, 10}, {2, 100}};

  const std::string svg = to_svg(plot);

  CHECK_THAT(svg, Contains("points=\"58.0,274.0 261.0,161.0 464.0,48.0 \""));
}

TEST_CASE("a series that breaks off ends in a cross")
{
  Plot plot = example();
  CHECK_THAT(to_svg(plot), !Contains("class=\"cross"));

  plot.series[0].breaks_off = true;

  CHECK_THAT(to_svg(plot), Contains("class=\"cross s0\""));
}

TEST_CASE("a plot without a single point is drawn empty")
{
  Plot plot = example();
  plot.series[0].points.clear();

  const std::string svg = to_svg(plot);

  CHECK_THAT(svg, Contains("</svg>") && !Contains("polyline") && !Contains("nan") && !Contains("inf"));
}

TEST_CASE("text in a plot cannot be taken for markup")
{
  Plot plot = example();
  plot.title = "<b> & \"c\"";

  const std::string svg = to_svg(plot);

  CHECK_THAT(svg, Contains("&lt;b&gt; &amp; &quot;c&quot;") && !Contains("<b>"));
}
