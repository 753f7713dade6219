#include "tools/study/richardson.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace tamp::tools::study
{

namespace
{

constexpr double highest_order = 2;
/// Below it what is missing would be several times as large as what was seen.
constexpr double lowest_order = 0.5;

/// (h1^p - h2^p) / (h2^p - h3^p), which grows with p.
double ratio_of_differences(double h1, double h2, double h3, double order)
{
  return std::expm1(order * std::log(h1 / h2)) / -std::expm1(order * std::log(h3 / h2));
}

/// The order at which the differences have this ratio; below 0 where it is too low, or there is none.
double order_of(double h1, double h2, double h3, double ratio)
{
  double low = lowest_order, high = 20;
  if (!(ratio >= ratio_of_differences(h1, h2, h3, low)) || std::isinf(ratio)) return -1;
  for (int i = 0; i < 100; ++i) {
    const double middle = (low + high) / 2;
    (ratio_of_differences(h1, h2, h3, middle) < ratio ? low : high) = middle;
  }
  return low;
}

bool fall(std::span<const double> differences)
{
  if (!std::all_of(differences.begin(), differences.end(), [](double d) { return std::isfinite(d); })) return false;
  for (std::size_t i = 1; i < differences.size(); ++i) {
    if (differences[i] * differences[i - 1] < 0 || std::abs(differences[i]) >= std::abs(differences[i - 1])) {
      return false;
    }
  }
  return true;
}

/// The straight line through some points, by least squares: their number, and sums over them.
struct LineFit {
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;

  void add(double u, double v) { n += 1, x += u, y += v, xx += u * u, xy += u * v; }
  double slope() const { return (n * xy - x * y) / (n * xx - x * x); }
};

}  // namespace

Convergence convergence(std::span<const double> spacings, std::span<const double> differences)
{
  const std::size_t n = differences.size();
  const bool none_differ = std::all_of(differences.begin(), differences.end(), [](double d) { return d == 0; });
  if (none_differ) return {true, 0, 0, "the answers are the same on all grids"};
  const double h1 = spacings[n - 2], h2 = spacings[n - 1], h3 = spacings[n];
  const double ratio = std::abs(differences[n - 2] / differences[n - 1]);
  const double order = fall(differences) ? order_of(h1, h2, h3, ratio) : -1;
  if (order < 0) {
    return {false, 0, 0,
            fmt::format("no bound: on the last grids the answer changes by {:.3g}, then by {:.3g}", differences[n - 2],
                        differences[n - 1])};
  }
  const double used = std::min(order, highest_order);
  const double rest = differences[n - 1] / std::expm1(used * std::log(h2 / h3));
  return {true, order, rest, fmt::format("differences fall by {:.2f} from grid to grid, order {:.2f}", ratio, order)};
}

double fitted_order(std::span<const double> spacings, std::span<const double> errors, std::size_t n_least)
{
  LineFit line;
  for (std::size_t i = 0; i < errors.size(); ++i) {
    if (errors[i] > 0) line.add(std::log(spacings[i]), std::log(errors[i]));
  }
  return line.n < static_cast<double>(n_least) ? NAN : line.slope();
}

double fitted_limit(std::span<const double> spacings, std::span<const double> answers, double order)
{
  constexpr double fewest = 3;
  LineFit line;
  for (std::size_t i = 0; i < answers.size(); ++i) line.add(std::pow(spacings[i], order), answers[i]);
  return line.n < fewest ? NAN : (line.y - line.slope() * line.x) / line.n;
}

}  // namespace tamp::tools::study
