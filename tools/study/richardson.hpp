#pragma once

#include <span>
#include <string>

namespace tamp::tools::study
{

/// The limit that answers on finer and finer grids tend to.
struct Convergence {
  /// Whether the differences fall from grid to grid, with one sign: nothing is claimed otherwise.
  bool falls = false;
  /// Order of the error in the spacing, from the last two differences.
  double order = 0;
  /// Distance of the finest answer from the limit, in the sign of the differences.
  double rest = 0;
  /// For people.
  std::string note;
};

/// `spacings` fall from coarse to fine, three or more; `differences` between answers on neighbouring ones, the finer
/// less the coarser, are one fewer. With error c h^p, the last differences are in the ratio (h1^p - h2^p) / (h2^p -
/// h3^p), which gives p, and the rest is that of the last difference times h3^p / (h2^p - h3^p) (Richardson). Orders
/// above 2, which no method here has, are taken as 2 there; below 1/2 nothing is claimed.
Convergence convergence(std::span<const double> spacings, std::span<const double> differences);

/// Slope of log(error) over log(spacing), by least squares; 0 errors are left out. NaN for fewer than `n_least`.
double fitted_order(std::span<const double> spacings, std::span<const double> errors, std::size_t n_least = 3);

/// a of the fit of answers by a + c h^order, by least squares. NaN for fewer than three, or where no two h differ.
double fitted_limit(std::span<const double> spacings, std::span<const double> answers, double order);

}  // namespace tamp::tools::study
