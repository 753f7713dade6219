#include "components/materials/crush_curve.hpp"

#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

namespace
{

/// The elastic strain, between 0 and `last`, at which the surface meets the hydrostat.
template <class Model>
double meeting_strain(const Model& model, const PiecewiseLinear& hydrostat, double plastic, double last)
{
  const auto excess = [&](double e) { return model.at(e, plastic).pressure - hydrostat(e + plastic); };
  double low = 0, high = last;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (excess(middle) < 0 ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

template <class Model>
PiecewiseLinear crush_curve_of(const Model& model, const PiecewiseLinear& hydrostat)
{
  constexpr int n_points = 1024;
  const double total = hydrostat.x().back();
  const double last_pressure = hydrostat.y().back();

  // The plastic strain left when the hydrostat's end is unloaded: p(total - plastic, plastic) = H(total).
  double low = 0, high = total;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (model.at(total - middle, middle).pressure > last_pressure ? low : high) = middle;
  }
  const double last = 0.5 * (low + high);

  std::vector<double> plastic{0}, crush{least_crush_pressure};
  for (int i = 1; i <= n_points; ++i) {
    const double ep = last * i / n_points;
    const double e = i < n_points ? meeting_strain(model, hydrostat, ep, total - ep) : total - ep;
    const double pressure = hydrostat(e + ep);
    if (pressure <= least_crush_pressure) continue;
    if (pressure <= crush.back()) {
      throw BadValue("at plastic strain " + std::to_string(ep) + " a consistent crush pressure of " +
                         std::to_string(pressure) + " after " + std::to_string(crush.back()),
                     "a modulus and a hydrostat that make it rise");
    }
    plastic.push_back(ep);
    crush.push_back(pressure);
  }
  return PiecewiseLinear(std::move(plastic), std::move(crush));
}

}  // namespace

PiecewiseLinear consistent_crush_curve(const Modulus& modulus, const PiecewiseLinear& hydrostat)
{
  if (!(hydrostat.x().front() >= 0 && hydrostat.y().back() > least_crush_pressure)) {
    throw BadValue("a hydrostat from strain " + std::to_string(hydrostat.x().front()) + " to pressure " +
                       std::to_string(hydrostat.y().back()),
                   "one from strain 0 to well above " + std::to_string(least_crush_pressure) + " Pa");
  }
  return std::visit([&](const auto& model) { return crush_curve_of(model, hydrostat); }, modulus);
}

}  // namespace tamp::components
