#include "components/moduli/unloading_table.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "components/curves/piecewise_linear.hpp"
#include "components/errors.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

namespace
{

constexpr std::size_t n_elastic_cells = 384;
/// The extension of a curve beyond its end: compliance (1/K) of its last point, until that of the next curve at the
/// same pressure is smaller; a jump down to the next curve is spread over a quarter of the end pressure, or over less
/// where the curve would use up more than half of `gap`, its distance in total strain from the next one.
void extend_along(std::vector<double>& pressure, std::vector<double>& elastic, double end_compliance,
                  const MonotoneCubic& next, double gap, double last_pressure)
{
  constexpr int n_steps = 400;
  const double start = pressure.back();
  const double ratio = portable::pow(last_pressure / start, 1.0 / n_steps);
  const double jump = std::max(end_compliance - next.at(start).slope, 0.0);
  const double spread = gap > 0 ? std::min(start / 4, gap / (2 * jump)) : start / 4;
  const auto compliance = [&](double p) { return std::min(end_compliance, next.at(p).slope); };
  const auto lag = [&](double p) { return jump * spread * portable::exp(-(p - start) / spread); };
  for (int i = 1; i <= n_steps; ++i) {
    const double from = pressure.back();
    const double to = i == n_steps ? last_pressure : from * ratio;
    const double simpson = compliance(from) + 4 * compliance(0.5 * (from + to)) + compliance(to);
    pressure.push_back(to);
    elastic.push_back(elastic.back() + (to - from) / 6 * simpson + lag(from) - lag(to));
  }
}

}  // namespace

UnloadingTable::UnloadingTable(std::span<const double> plastic, std::span<const double> elastic,
                               std::span<const double> pressure)
{
  read_curves(plastic, elastic, pressure);
  extend_curves();
  check_curves_do_not_cross();
  make_surface_grid();
  pressure_modulus_.emplace(curve_plastic_, measured_);
}

void UnloadingTable::read_curves(std::span<const double> plastic, std::span<const double> elastic,
                                 std::span<const double> pressure)
{
  const std::size_t n = plastic.size();
  if (elastic.size() != n || pressure.size() != n) throw BadValue("columns of unequal length", "equal lengths");
  if (n == 0) throw BadValue("no unloading curve", "at least one");

  for (std::size_t start = 0, end = 0; start < n; start = end) {
    const auto row = static_cast<std::ptrdiff_t>(start);
    const double strain = plastic[start];
    const double least = curve_plastic_.empty() ? 0 : curve_plastic_.back();
    if (!std::isfinite(strain) || strain < 0 || (!curve_plastic_.empty() && strain <= least)) {
      throw BadValue("plastic strain " + std::to_string(strain), "ascending plastic strains, none negative", row);
    }
    while (end < n && plastic[end] == strain) ++end;
    const std::size_t count = end - start;
    if (count < 3) throw BadValue("a curve of " + std::to_string(count) + " rows", "at least three rows", row);
    if (elastic[start] != 0 || pressure[start] != 0) {
      throw BadValue("an unloading curve that starts at elastic strain " + std::to_string(elastic[start]) +
                         ", pressure " + std::to_string(pressure[start]),
                     "elastic strain 0, pressure 0", row);
    }
    const auto checked = [&](std::span<const double> column, const char* what) {
      try {
        check_strictly_increasing(column.subspan(start, count), what);
      } catch (const BadValue& bad) {
        throw BadValue(bad.found, bad.expected, row + bad.row);
      }
      return std::vector<double>(column.begin() + row, column.begin() + static_cast<std::ptrdiff_t>(end));
    };
    std::vector<double> e = checked(elastic, "elastic strain");
    MonotoneCubic curve(checked(pressure, "pressure"), std::move(e));
    if (curve_plastic_.empty() && strain > 0) {
      curve_plastic_.push_back(0);
      curve_row_.push_back(row);
      measured_.push_back(curve);
    }
    curve_plastic_.push_back(strain);
    curve_row_.push_back(row);
    measured_.push_back(std::move(curve));
    last_pressure_ = std::max(last_pressure_, pressure[end - 1]);
  }
  if (measured_.size() < 2)
    throw BadValue("one unloading curve, at plastic strain 0", "one at a greater plastic strain");
}

void UnloadingTable::extend_curves()
{
  extended_ = measured_;
  const std::size_t n = measured_.size();
  for (std::size_t k = n - 1; k-- > 0;) {
    const MonotoneCubic& own = measured_[k];
    if (own.x().back() >= last_pressure_) continue;
    std::vector<double> pressure(own.x().begin(), own.x().end());
    std::vector<double> elastic(own.y().begin(), own.y().end());
    const double end_compliance = own.at(pressure.back()).slope;
    const double next = curve_plastic_[k + 1] + extended_[k + 1].at(pressure.back()).value;
    const double gap = std::max(next - curve_plastic_[k] - elastic.back(), 0.0);
    extend_along(pressure, elastic, end_compliance, extended_[k + 1], gap, last_pressure_);
    extended_[k] = MonotoneCubic(std::move(pressure), std::move(elastic));
  }
}

void UnloadingTable::check_curves_do_not_cross() const
{
  constexpr int n_checks = 1000;
  for (std::size_t k = 0; k + 1 < extended_.size(); ++k) {
    for (int i = 1; i <= n_checks; ++i) {
      const double p = last_pressure_ * i * i / (n_checks * n_checks);
      const double total = curve_plastic_[k] + extended_[k].at(p).value;
      const double next = curve_plastic_[k + 1] + extended_[k + 1].at(p).value;
      if (next <= total) {
        throw BadValue("at pressure " + std::to_string(p) + " a total strain of " + std::to_string(next) +
                           " after more plastic strain, " + std::to_string(total) + " after less",
                       "more total strain on the curve of more plastic strain", curve_row_[k + 1]);
      }
    }
  }
}

UnloadingTable::StrainAtPressure UnloadingTable::strain_at(double pressure, double plastic) const
{
  std::vector<double> total(extended_.size());
  for (std::size_t k = 0; k < total.size(); ++k) total[k] = curve_plastic_[k] + extended_[k].at(pressure).value;
  const std::vector<double> slopes = monotone_slopes(curve_plastic_, total);
  const std::size_t k = curve_below(plastic);
  const CubicValue t = cubic(curve_plastic_[k + 1] - curve_plastic_[k], total[k], slopes[k], total[k + 1],
                             slopes[k + 1], plastic - curve_plastic_[k]);
  return {t.value - plastic, t.slope - 1};
}

void UnloadingTable::make_surface_grid()
{
  const std::size_t n_curves = extended_.size();
  const std::size_t n_lines = (n_curves - 1) * n_lines_a_curve + 1;
  for (const MonotoneCubic& curve : extended_) last_elastic_ = std::max(last_elastic_, curve.y().back());
  n_elastic_ = n_elastic_cells + 1;
  last_cell_ = n_elastic_cells - 1;
  const double spacing = last_elastic_ / static_cast<double>(n_elastic_cells);
  elastic_per_spacing_ = 1 / spacing;
  nodes_.resize(n_lines * n_elastic_);

  // Pressures dense enough at both ends of the range to carry each line as a curve.
  constexpr std::size_t n_pressures = 1500;
  std::vector<double> pressures(n_pressures);
  for (std::size_t j = 0; j < n_pressures; ++j) {
    const double fraction = static_cast<double>(j) / (n_pressures - 1);
    pressures[j] = last_pressure_ * portable::expm1(8.5 * fraction) / portable::expm1(8.5);
  }

  std::vector<double> plastic_of_line(n_lines);
  for (std::size_t k = 0; k + 1 < n_curves; ++k) {
    const double width = curve_plastic_[k + 1] - curve_plastic_[k];
    lines_per_strain_.push_back(n_lines_a_curve / width);
    for (std::size_t m = 0; m <= n_lines_a_curve; ++m) {
      plastic_of_line[k * n_lines_a_curve + m] = curve_plastic_[k] + width * static_cast<double>(m) / n_lines_a_curve;
    }
  }

  std::vector<std::vector<double>> elastic(n_lines, std::vector<double>(n_pressures));
  std::vector<std::vector<double>> by_plastic = elastic;
  for (std::size_t j = 0; j < n_pressures; ++j) {
    for (std::size_t line = 0; line < n_lines; ++line) {
      const StrainAtPressure strain = strain_at(pressures[j], plastic_of_line[line]);
      elastic[line][j] = strain.elastic;
      by_plastic[line][j] = strain.by_plastic;
    }
  }

  for (std::size_t line = 0; line < n_lines; ++line) {
    check_rises(elastic[line], pressures, plastic_of_line[line]);
    const MonotoneCubic pressure_of_elastic(elastic[line], pressures);
    const PiecewiseLinear by_plastic_of_elastic(elastic[line], by_plastic[line]);
    Node* const node = &nodes_[line * n_elastic_];
    const double end = elastic[line].back();
    for (std::size_t i = 0; i < n_elastic_; ++i) {
      const double e = spacing * static_cast<double>(i);
      const CubicValue p = pressure_of_elastic.at(e);
      // Along a line of equal pressure dp = 0 = K de + coupling d(plastic).
      node[i] = {p.value, p.slope * spacing, -by_plastic_of_elastic(std::min(e, end)) * p.slope, 0};
    }
    for (std::size_t i = 0; i < n_elastic_; ++i) {
      const std::size_t before = i == 0 ? 0 : i - 1, after = std::min(i + 1, n_elastic_ - 1);
      node[i].coupling_by_elastic =
          (node[after].coupling - node[before].coupling) / static_cast<double>(after - before);
    }
  }

  find_least_bulk_modulus(plastic_of_line);
}

void UnloadingTable::check_rises(std::span<const double> elastic, std::span<const double> pressures,
                                 double plastic) const
{
  const auto falls = std::adjacent_find(elastic.begin(), elastic.end(), std::greater_equal<>());
  if (falls == elastic.end()) return;
  const auto at = static_cast<std::size_t>(falls - elastic.begin());
  refuse_between_curves("strain does not rise", pressures[at], plastic);
}

void UnloadingTable::refuse_between_curves(const std::string& found, double pressure, double plastic) const
{
  // Below the first measured curve its shape is kept, and only the next one can bend it.
  const bool is_copy = curve_row_.size() > 2 && curve_row_[0] == curve_row_[1];
  const std::size_t k = std::max(curve_below(plastic), is_copy ? std::size_t{1} : std::size_t{0});
  throw BadValue("near the curves of plastic strain " + std::to_string(curve_plastic_[k]) + " and " +
                     std::to_string(curve_plastic_[k + 1]) + " " + found + " at pressure " + std::to_string(pressure) +
                     ", plastic strain " + std::to_string(plastic),
                 "curves that neither cross nor come close", curve_row_[k + 1]);
}

void UnloadingTable::find_least_bulk_modulus(std::span<const double> plastic_of_line)
{
  const double spacing = last_elastic_ / static_cast<double>(n_elastic_cells);
  double elastic = 0, plastic = 0;
  least_bulk_modulus_ = at(elastic, plastic).bulk_modulus;
  for (std::size_t line = 0; line + 1 < plastic_of_line.size(); ++line) {
    const double half_way = 0.5 * (plastic_of_line[line] + plastic_of_line[line + 1]);
    for (std::size_t i = 0; i < 2 * n_elastic_; ++i) {
      const double e = 0.5 * spacing * static_cast<double>(i);
      for (double ep : {plastic_of_line[line], half_way}) {
        const double modulus = at(e, ep).bulk_modulus;
        if (!(modulus < least_bulk_modulus_)) continue;
        least_bulk_modulus_ = modulus;
        elastic = e;
        plastic = ep;
      }
    }
  }
  if (least_bulk_modulus_ > 0) return;
  refuse_between_curves("the bulk modulus is " + std::to_string(least_bulk_modulus_), at(elastic, plastic).pressure,
                        plastic);
}

bool UnloadingTable::in_range(double elastic, double plastic) const
{
  if (!(elastic >= least_elastic && plastic >= 0 && plastic <= curve_plastic_.back())) return false;
  const std::size_t k = curve_below(plastic);
  const double s = (plastic - curve_plastic_[k]) / (curve_plastic_[k + 1] - curve_plastic_[k]);
  return elastic <= (1 - s) * measured_[k].y().back() + s * measured_[k + 1].y().back();
}

ElasticPoint UnloadingTable::defined_at(double elastic, double plastic) const
{
  const double ep = std::clamp(plastic, 0.0, curve_plastic_.back());
  const double ee = std::max(elastic, 0.0);
  double low = 0, high = 2 * last_pressure_;
  while (strain_at(high, ep).elastic < ee) high *= 2;
  for (int i = 0; i < 200 && high - low > 1e-15 * high; ++i) {
    const double middle = 0.5 * (low + high);
    (strain_at(middle, ep).elastic < ee ? low : high) = middle;
  }
  const double p = 0.5 * (low + high);
  const double dp = 1e-5 * (p + 1e-5 * last_pressure_);
  const double from = std::max(p - dp, 0.0);
  const double modulus = (p + dp - from) / (strain_at(p + dp, ep).elastic - strain_at(from, ep).elastic);
  const double coupling = plastic == ep ? -strain_at(p, ep).by_plastic * modulus : 0;
  return {p + modulus * (elastic - ee), modulus, coupling};
}

}  // namespace tamp::components
