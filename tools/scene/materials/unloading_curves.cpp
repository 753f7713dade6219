#include "tools/scene/materials/unloading_curves.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/curves/piecewise_linear.hpp"
#include "components/errors.hpp"
#include "components/portable_math.hpp"
#include "tools/scene/files/file_kind.hpp"
#include "tools/scene/tables/csv_table.hpp"
#include "tools/scene/tables/published_table.hpp"

namespace tamp::tools
{

namespace
{

using Lists = PublishedTable::Curve;

/// `row` counts in the lists that the point comes from; -1 for the curve's start.
struct Point {
  double elastic, pressure;
  std::ptrdiff_t row = -1;
};

void check_ascending(const Lists& curve, const std::string& name)
{
  try {
    components::check_strictly_increasing(curve.lists.at(name), name.c_str());
  } catch (const components::BadValue& bad) {
    throw InputError({curve.place_of(name, bad.row), bad.found, "expected " + bad.expected});
  }
}

/// The part in compression of pressure against strain, which is `plastic` at zero pressure.
std::vector<Point> unloading_curve(const Lists& curve, const std::string& strain, double plastic)
{
  check_ascending(curve, strain);
  const std::vector<double>& strains = curve.lists.at(strain);
  const std::vector<double>& pressures = curve.lists.at("Pressure");
  std::vector<Point> points{{0, 0}};
  for (std::size_t i = 0; i < strains.size(); ++i) {
    const auto row = static_cast<std::ptrdiff_t>(i);
    if (pressures[i] <= 0) continue;
    if (strains[i] <= plastic) {
      throw InputError({curve.place_of("Pressure", row), fmt::format("{} at {} {}", pressures[i], strain, strains[i]),
                        fmt::format("expected no pressure up to the plastic strain, {}", plastic)});
    }
    points.push_back({strains[i] - plastic, pressures[i], row});
  }
  if (points.size() < 2) throw InputError({curve.place, "no point in compression", "expected pressures above 0"});
  return points;
}

/// A modulus given at x, pressure or elastic strain; straight between such.
struct ModulusPoint {
  double x, modulus;
  std::ptrdiff_t row = -1;
};

/// The part from x = 0 on; before the first point the modulus is the first.
std::vector<ModulusPoint> modulus_in_compression(const Lists& curve, const std::string& abscissa)
{
  check_ascending(curve, abscissa);
  const std::vector<double>& x = curve.lists.at(abscissa);
  const std::vector<double>& modulus = curve.lists.at("BulkModulus");
  const auto bad = std::find_if(modulus.begin(), modulus.end(), [](double k) { return !(k > 0); });
  if (bad != modulus.end()) {
    throw InputError({curve.place_of("BulkModulus", bad - modulus.begin()), fmt::format("{}", *bad),
                      "expected a bulk modulus above 0"});
  }

  const auto i = static_cast<std::size_t>(std::upper_bound(x.begin(), x.end(), 0.0) - x.begin());
  double at_zero = modulus[i == 0 ? 0 : i - 1];
  if (i > 0 && i < x.size()) at_zero = std::lerp(at_zero, modulus[i], -x[i - 1] / (x[i] - x[i - 1]));
  std::vector<ModulusPoint> points{{0, at_zero}};
  for (std::size_t k = i; k < x.size(); ++k) points.push_back({x[k], modulus[k], static_cast<std::ptrdiff_t>(k)});
  if (points.size() < 2) {
    throw InputError({curve.place, "no point in compression", fmt::format("expected {} above 0", abscissa)});
  }
  return points;
}

/// Points so close that the modulus changes by less than 2 % from one to the next: a cubic through the integrated curve
/// then has the modulus of the table.
std::vector<ModulusPoint> refined(const std::vector<ModulusPoint>& points)
{
  std::vector<ModulusPoint> fine{points.front()};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const ModulusPoint &from = points[i - 1], &to = points[i];
    const double n = std::clamp(std::ceil(std::abs(portable::log(to.modulus / from.modulus)) / 0.02), 1.0, 1000.0);
    for (double k = 1; k <= n; ++k) {
      fine.push_back({std::lerp(from.x, to.x, k / n), std::lerp(from.modulus, to.modulus, k / n), to.row});
    }
  }
  return fine;
}

std::vector<Point> integrated_over_pressure(const std::vector<ModulusPoint>& modulus)
{
  std::vector<Point> points{{0, 0}};
  for (std::size_t i = 1; i < modulus.size(); ++i) {
    const ModulusPoint &from = modulus[i - 1], &to = modulus[i];
    const double change = (to.modulus - from.modulus) / from.modulus;
    const double compliance = (change == 0 ? 1 : portable::log1p(change) / change) / from.modulus;
    points.push_back({points.back().elastic + compliance * (to.x - from.x), to.x, to.row});
  }
  return points;
}

std::vector<Point> integrated_over_strain(const std::vector<ModulusPoint>& modulus)
{
  std::vector<Point> points{{0, 0}};
  for (std::size_t i = 1; i < modulus.size(); ++i) {
    const ModulusPoint &from = modulus[i - 1], &to = modulus[i];
    points.push_back({to.x, points.back().pressure + 0.5 * (from.modulus + to.modulus) * (to.x - from.x), to.row});
  }
  return points;
}

/// The curve that the lists give, whatever pair of variables they hold.
std::vector<Point> points_of(const Lists& curve, double plastic, const PublishedTable& published)
{
  const auto holds = [&](const char* x, const char* y) {
    return curve.lists.size() == 2 && curve.lists.contains(x) && curve.lists.contains(y);
  };
  if (holds("TotalStrainVol", "Pressure")) return unloading_curve(curve, "TotalStrainVol", plastic);
  if (holds("ElasticStrainVol", "Pressure")) return unloading_curve(curve, "ElasticStrainVol", 0);
  if (holds("Pressure", "BulkModulus")) {
    return integrated_over_pressure(refined(modulus_in_compression(curve, "Pressure")));
  }
  if (holds("ElasticStrainVol", "BulkModulus")) {
    return integrated_over_strain(refined(modulus_in_compression(curve, "ElasticStrainVol")));
  }
  throw InputError(published.unsuitable(
      "expected, for each PlasticStrainVol, Pressure against TotalStrainVol or ElasticStrainVol, or BulkModulus "
      "against Pressure or ElasticStrainVol"));
}

/// A published curve for plastic strain zero may be the hydrostat: the path of loading, which all other curves start
/// from, so that it meets the next one, and pressure would be no function of elastic and plastic strain. It ends, for
/// us, where it has come half way to the next one; UnloadingTable goes on from there.
void end_before_next(std::vector<Point>& points, double apart, const std::vector<Point>& next)
{
  const auto next_elastic = [&](double pressure) {
    const auto after = std::lower_bound(next.begin(), next.end(), pressure,
                                        [](const Point& p, double value) { return p.pressure < value; });
    const Point &to = after == next.end() ? next.back() : *after, &from = *(&to - 1);
    return std::lerp(from.elastic, to.elastic, (pressure - from.pressure) / (to.pressure - from.pressure));
  };
  const auto is_near = [&](const Point& p) { return p.elastic - next_elastic(p.pressure) > apart / 2; };
  points.erase(std::find_if(points.begin() + 2, points.end(), is_near), points.end());
}

void append(Table& table, const Lists& curve, double plastic, std::vector<Point> points)
{
  // The straight line between two points, by three numbers.
  if (points.size() == 2) points.insert(points.begin() + 1, {points[1].elastic / 2, points[1].pressure / 2});
  for (const Point& p : points) {
    table.columns[0].push_back(plastic);
    table.columns[1].push_back(p.elastic);
    table.columns[2].push_back(p.pressure);
    table.place_of_row.push_back(curve.place_of(curve.lists.begin()->first, p.row));
  }
}

Table read_published_curves(const std::filesystem::path& file)
{
  const PublishedTable published = read_published_table(file);
  const std::size_t level = published.level("PlasticStrainVol");
  if (level == published.levels.size() || !published.depends_on_no_level_but("PlasticStrainVol")) {
    throw InputError(published.unsuitable("expected a level PlasticStrainVol, and one entry of every other"));
  }

  std::vector<std::vector<Point>> points;
  double last = -std::numeric_limits<double>::infinity();
  for (const Lists& curve : published.curves) {
    const double plastic = curve.at[level];
    if (plastic <= last) {
      throw InputError({curve.place, fmt::format("PlasticStrainVol {} after {}", plastic, last),
                        "expected plastic strains that strictly increase"});
    }
    last = plastic;
    points.push_back(points_of(curve, plastic, published));
  }

  Table table{file, std::vector<std::vector<double>>(3), {}};
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double plastic = published.curves[k].at[level];
    if (plastic < 0) continue;
    if (plastic == 0 && k + 1 < points.size()) {
      end_before_next(points[k], published.curves[k + 1].at[level], points[k + 1]);
    }
    append(table, published.curves[k], plastic, std::move(points[k]));
  }
  return table;
}

void convert_to_logarithmic(Table& table, StrainMeasure measure)
{
  if (measure == StrainMeasure::logarithmic) return;
  std::vector<double>&plastic = table.columns[0], &elastic = table.columns[1];
  const auto add = [](double a, double b) { return a + b; };
  const auto subtract = [](double a, double b) { return a - b; };
  std::transform(elastic.begin(), elastic.end(), plastic.begin(), elastic.begin(), add);
  convert_to_logarithmic(table, 0, measure);
  convert_to_logarithmic(table, 1, measure);
  std::transform(elastic.begin(), elastic.end(), plastic.begin(), elastic.begin(), subtract);
}

}  // namespace

Table read_unloading_curves(const std::filesystem::path& file, StrainMeasure measure)
{
  const bool is_published = file_kind(file) == FileKind::json;
  Table table = is_published ? read_published_curves(file)
                             : read_csv_table(file, {"plastic_volumetric[-]", "elastic_volumetric[-]", "pressure[Pa]"});
  convert_to_logarithmic(table, measure);
  return table;
}

}  // namespace tamp::tools
