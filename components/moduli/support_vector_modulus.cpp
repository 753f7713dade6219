#include "components/moduli/support_vector_modulus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

namespace
{

constexpr double least_share_of_modulus = 0.05;  // of K at elastic strain zero
constexpr int most_kernel_widths = 20;           // across the box, in 1 / sqrt(gamma)

void require_positive(double value, const std::string& name)
{
  if (!(std::isfinite(value) && value > 0)) throw BadValue(name + " " + std::to_string(value), "a positive number");
}

void require_finite(double value, const std::string& name, std::ptrdiff_t row = -1)
{
  if (!std::isfinite(value)) throw BadValue(name + " " + std::to_string(value), "a finite number", row);
}

void check_input(const SupportVectorFit::Input& input, double gamma, const std::string& strain)
{
  require_positive(input.unit, "unit of " + strain);
  require_positive(input.scale, "scale of " + strain);
  require_finite(input.lower, "lower bound of " + strain);
  require_finite(input.upper, "upper bound of " + strain);
  const double width = input.upper - input.lower;
  if (!(width > 0)) {
    throw BadValue(strain + " from " + std::to_string(input.lower) + " to " + std::to_string(input.upper),
                   "a lower bound below the upper");
  }
  if (const double kernels = width * input.scale * std::sqrt(gamma); kernels > most_kernel_widths) {
    throw BadValue("gamma " + std::to_string(gamma) + ", a kernel that fits " + std::to_string(kernels) +
                       " times into the range of " + strain,
                   "at most " + std::to_string(most_kernel_widths) + " times");
  }
}

/// The strains that a fit was made for.
struct Box {
  Interval total, plastic;
};

Box box_of(const SupportVectorFit& fit)
{
  return {{fit.total.lower * fit.total.unit, fit.total.upper * fit.total.unit},
          {std::max(0.0, fit.plastic.lower * fit.plastic.unit), fit.plastic.upper * fit.plastic.unit}};
}

void check_box(const Box& box)
{
  const auto& [total, plastic] = box;
  if (!(plastic.high > plastic.low)) {
    throw BadValue("plastic strains up to " + std::to_string(plastic.high), "positive ones");
  }
  if (total.low > plastic.low || total.high < plastic.high) {
    const auto from_to = [](Interval i) { return "from " + std::to_string(i.low) + " to " + std::to_string(i.high); };
    throw BadValue("total strains " + from_to(total) + ", plastic ones " + from_to(plastic),
                   "total strains that include the plastic ones, since they are equal at elastic strain 0");
  }
}

void check(const SupportVectorFit& fit)
{
  if (fit.vectors.empty()) throw BadValue("no support vector", "at least one");
  if (fit.coefficients.size() != fit.vectors.size()) {
    throw BadValue(std::to_string(fit.coefficients.size()) + " coefficients for " + std::to_string(fit.vectors.size()) +
                       " support vectors",
                   "one for each");
  }
  for (std::size_t j = 0; j < fit.vectors.size(); ++j) {
    const auto row = static_cast<std::ptrdiff_t>(j);
    for (const double x : fit.vectors[j]) require_finite(x, "support vector at", row);
    require_finite(fit.coefficients[j], "coefficient", row);
  }
  require_positive(fit.gamma, "gamma");
  require_positive(fit.pressure_unit, "unit of pressure");
  require_positive(fit.pressure_scale, "scale of pressure");
  require_finite(fit.pressure_lower, "lower bound of pressure");
  require_finite(fit.intercept, "intercept");
  check_input(fit.total, fit.gamma, "total strain");
  check_input(fit.plastic, fit.gamma, "plastic strain");
  check_box(box_of(fit));
}

/// Pressure as the fit has it, of strains.
GaussianSum pressure_of(const SupportVectorFit& fit, ZeroPressure zero)
{
  check(fit);
  const auto sharpness = [&](const SupportVectorFit::Input& input) {
    const long double scaled_per_strain = static_cast<long double>(input.scale) / input.unit;
    return fit.gamma * scaled_per_strain * scaled_per_strain;
  };
  const auto strain = [](const SupportVectorFit::Input& input, long double scaled) {
    return (scaled / input.scale + input.lower) * input.unit;
  };
  const long double per_output = static_cast<long double>(fit.pressure_unit) / fit.pressure_scale;
  Gaussians gaussians{sharpness(fit.total), sharpness(fit.plastic), {}};
  for (std::size_t j = 0; j < fit.vectors.size(); ++j) {
    const auto [total, plastic] = fit.vectors[j];
    gaussians.peaks.push_back(
        {strain(fit.total, total), strain(fit.plastic, plastic), fit.coefficients[j] * per_output});
  }

  const Box box = box_of(fit);
  GaussianSum pressure(gaussians, box.total, box.plastic);
  if (zero == ZeroPressure::as_fitted) {
    pressure.add(fit.intercept * per_output + static_cast<long double>(fit.pressure_lower) * fit.pressure_unit);
  } else {
    pressure.subtract_diagonal(gaussians);
  }
  return pressure;
}

}  // namespace

SupportVectorModulus::SupportVectorModulus(const SupportVectorFit& fit, ZeroPressure zero)
    : pressure_(pressure_of(fit, zero))
{
  const Box box = box_of(fit);
  range_.least_plastic = box.plastic.low;
  range_.most_plastic = box.plastic.high;
  find_trusted(box.total);
}

void SupportVectorModulus::find_trusted(Interval total)
{
  constexpr std::size_t n_cells = 256;
  const double spacing = (range_.most_plastic - range_.least_plastic) / n_cells;
  nodes_per_strain_ = 1 / spacing;
  const auto plastic_of = [&](std::size_t node) { return range_.least_plastic + spacing * static_cast<double>(node); };

  std::vector<Interval> trusted;
  for (std::size_t i = 0; i <= n_cells; ++i) {
    trusted.push_back({trusted_end(plastic_of(i), total.low), trusted_end(plastic_of(i), total.high)});
  }

  // Each node takes the narrowest of its neighbours', so that the line between two nodes stays inside.
  range_.least_elastic = total.low;
  range_.most_elastic = total.high;
  for (std::size_t i = 0; i <= n_cells; ++i) {
    const Interval &before = trusted[i == 0 ? 0 : i - 1], &after = trusted[std::min(i + 1, n_cells)];
    const double plastic = plastic_of(i);
    const double low = std::min(std::max({before.low, trusted[i].low, after.low}), plastic);
    const double high = std::max(std::min({before.high, trusted[i].high, after.high}), plastic);
    trusted_.push_back({low, high});
    range_.least_elastic = std::max(range_.least_elastic, low - plastic);
    range_.most_elastic = std::min(range_.most_elastic, high - plastic);
  }
}

/// From elastic strain zero towards an end of the box, the total strain as far as K is stiff enough.
double SupportVectorModulus::trusted_end(double plastic, double box_end) const
{
  const double unstrained = pressure_.by_x_at(plastic, plastic);
  if (!(unstrained > 0)) {
    throw BadValue("bulk modulus " + std::to_string(unstrained) + " Pa at elastic strain 0, plastic strain " +
                       std::to_string(plastic),
                   "a positive modulus at elastic strain 0");
  }
  const auto is_stiff = [&](double total) {
    return pressure_.by_x_at(total, plastic) >= least_share_of_modulus * unstrained;
  };

  constexpr int n_steps = 128;
  double stiff = plastic, soft = box_end;
  for (int i = 1; i <= n_steps; ++i) {
    soft = plastic + (box_end - plastic) * i / n_steps;
    if (!is_stiff(soft)) break;
    stiff = soft;
  }
  if (stiff == soft) return box_end;
  for (int i = 0; i < 50; ++i) {
    const double middle = 0.5 * (stiff + soft);
    (is_stiff(middle) ? stiff : soft) = middle;
  }
  return stiff;
}

template <class Number>
[[gnu::always_inline]] inline SupportVectorModulus::Place<Number> SupportVectorModulus::place_of(
    const Number& elastic, const Number& plastic) const
{
  // In this order a plastic strain that is not a number counts as the least.
  const Number ep = lesser_of<Number>(greater_of<Number>(range_.least_plastic, plastic), range_.most_plastic);
  const Number nodes = (ep - range_.least_plastic) * nodes_per_strain_;
  const Number node = lesser_of<Number>(truncated(nodes), static_cast<double>(trusted_.size() - 2));
  const Number fraction = nodes - node;
  std::array<const double*, n_lanes_of<Number>> places;
  const auto i = whole_parts(node);
  for (std::size_t l = 0; l < places.size(); ++l) places[l] = &trusted_[static_cast<std::size_t>(i[l])].low;
  const auto [low_here, high_here, low_next, high_next] = side_by_side<4>(places);
  const Number low_change = low_next - low_here, high_change = high_next - high_here;

  const Number total = elastic + ep;
  const Number low = low_here + fraction * low_change, high = high_here + fraction * high_change;
  const Number trusted = lesser_of(greater_of(low, total), high);
  const Number by_plastic = select(total < low, low_change * nodes_per_strain_,
                                   select(total > high, high_change * nodes_per_strain_, Number(1.0)));
  return {trusted, ep, total - trusted, by_plastic, plastic != ep};
}

template <class Number>
ElasticPointOf<Number> SupportVectorModulus::point_at(const Number& elastic, const Number& plastic) const
{
  const Place<Number> place = place_of(elastic, plastic);
  const GaussianSum::Values<Number> p = pressure_.at(place.total, place.plastic);
  // At an edge in total strain, T, p = f(T) + f_T (total - T), and T moves with the plastic strain.
  const Number modulus_by_plastic = p.by_xx * place.total_by_plastic + p.by_xy;
  const Number coupling = p.by_x + p.by_y + place.beyond * modulus_by_plastic;
  return {p.f + p.by_x * place.beyond, p.by_x, select(place.held, Number(0.0), coupling)};
}

template <class Number>
Number SupportVectorModulus::modulus_at(const Number& elastic, const Number& plastic) const
{
  const Place<Number> place = place_of(elastic, plastic);
  return pressure_.by_x_at(place.total, place.plastic);
}

ElasticPoint SupportVectorModulus::at(double elastic, double plastic) const
{
  return point_at(elastic, plastic);
}
ElasticPointOf<Lanes> SupportVectorModulus::at(const Lanes& elastic, const Lanes& plastic) const
{
  return point_at(elastic, plastic);
}

double SupportVectorModulus::rate_modulus(double /*pressure*/, double elastic, double plastic) const
{
  return modulus_at(elastic, plastic);
}
Lanes SupportVectorModulus::rate_modulus(const Lanes& /*pressure*/, const Lanes& elastic, const Lanes& plastic) const
{
  return modulus_at(elastic, plastic);
}

double SupportVectorModulus::modulus_by_plastic(double elastic, double plastic) const
{
  const Place<double> place = place_of(elastic, plastic);
  const GaussianSum::Values<double> p = pressure_.at(place.total, place.plastic);
  return place.held ? 0 : p.by_xx * place.total_by_plastic + p.by_xy;
}

bool SupportVectorModulus::in_range(double elastic, double plastic) const
{
  const Place<double> place = place_of(elastic, plastic);
  return place.beyond == 0 && !place.held;
}

}  // namespace tamp::components
