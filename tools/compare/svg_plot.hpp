#pragma once

#include <string>
#include <vector>

#include "tools/compare/plot_scale.hpp"

namespace tamp::tools::compare
{

struct PlotSeries {
  std::string name;
  std::vector<PlotPoint> points;  ///< in the order of x; finite, y above 0 on a logarithmic axis
  bool breaks_off = false;        ///< marked with a cross at its end
};

/// Lines over x, which starts at 0. Ticks have SI prefixes; numbers are in SI units.
struct Plot {
  std::string title;
  std::string x_name, x_unit;
  std::string y_name, y_unit;
  bool logarithmic = false;
  std::vector<PlotSeries> series;
};

/// An <svg> element to stand in a page that has `plot_style()`. Series are told apart by colour and by dashes.
std::string to_svg(const Plot& plot);

/// The plots' style sheet, for light and for dark pages.
std::string plot_style();

/// Text as it stands between tags or in a quoted attribute.
std::string escaped(const std::string& text);

}  // namespace tamp::tools::compare
