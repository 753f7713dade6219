#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>

#include "components/lanes.hpp"

namespace tamp::components
{

/// An elastic model's answer for one state. Pascal; compression positive.
template <class Number>
struct ElasticPointOf {
  Number pressure;
  Number bulk_modulus;  ///< K = d pressure / d elastic volumetric strain, positive
  Number coupling;      ///< d pressure / d plastic volumetric strain, at the same elastic strain
};
using ElasticPoint = ElasticPointOf<double>;

/// The elastic volumetric strains (logarithmic, compression positive) that a model was made for, and the plastic ones.
/// Outside, a model extrapolates as it states: continuously, with K positive and bounded.
struct StrainRange {
  double least_elastic, most_elastic;
  double least_plastic, most_plastic;

  bool contains(double elastic, double plastic) const
  {
    return elastic >= least_elastic && elastic <= most_elastic && plastic >= least_plastic && plastic <= most_plastic;
  }
};

/// A model of the sand's elasticity, in two readings:
///  - state form, `at`: pressure as a function of elastic and plastic volumetric strain;
///  - rate form, `rate_modulus`: the K of dp = K d(elastic), which the published Table takes at the pressure, and the
///    published SVR and MLP at the strains.
/// Both also answer as many states at once as there are lanes, each with the same bits as by itself.
/// `modulus_by_plastic` is dK/d(plastic) at the same elastic strain, in state form. `in_range` and
/// `rate_in_range` are false where the answer is an extrapolation; `range` is a rectangle on which that of the state
/// form is none.
template <class Model>
concept ElasticModel = requires(const Model& model, double pressure, double elastic, double plastic, Lanes strains)
{
  ElasticPoint(model.at(elastic, plastic));
  ElasticPointOf<Lanes>(model.at(strains, strains));
  double(model.rate_modulus(pressure, elastic, plastic));
  Lanes(model.rate_modulus(strains, strains, strains));
  double(model.modulus_by_plastic(elastic, plastic));
  bool(model.in_range(elastic, plastic));
  bool(model.rate_in_range(pressure, elastic, plastic));
  StrainRange(model.range());
};

/// `in_range` and `rate_in_range` for lanes: one by one where the model has no lanes of its own.
template <ElasticModel Model>
Mask<Lanes> in_range(const Model& model, const Lanes& elastic, const Lanes& plastic)
{
  return each_lane([&](std::size_t l) { return model.in_range(elastic[l], plastic[l]) ? 1.0 : 0.0; }) > 0.0;
}
template <ElasticModel Model>
Mask<Lanes> rate_in_range(const Model& model, const Lanes& pressure, const Lanes& elastic, const Lanes& plastic)
{
  if constexpr (requires { Mask<Lanes>(model.rate_in_range(pressure, elastic, plastic)); }) {
    return model.rate_in_range(pressure, elastic, plastic);
  } else {
    return each_lane([&](std::size_t l) {
             return model.rate_in_range(pressure[l], elastic[l], plastic[l]) ? 1.0 : 0.0;
           }) > 0.0;
  }
}

/// The state form of a batch: spans of equal length.
template <ElasticModel Model>
void evaluate(const Model& model, std::span<const double> elastic, std::span<const double> plastic,
              std::span<ElasticPoint> points)
{
  for (std::size_t i = 0; i < points.size(); i += n_lanes) {
    const ElasticPointOf<Lanes> found = model.at(lanes_at(elastic, i), lanes_at(plastic, i));
    for (std::size_t l = 0; l < n_lanes && i + l < points.size(); ++l) {
      points[i + l] = {found.pressure[l], found.bulk_modulus[l], found.coupling[l]};
    }
  }
}

/// The rate form of a batch: spans of equal length.
template <ElasticModel Model>
void evaluate_rate(const Model& model, std::span<const double> pressure, std::span<const double> elastic,
                   std::span<const double> plastic, std::span<double> bulk_modulus)
{
  for (std::size_t i = 0; i < bulk_modulus.size(); i += n_lanes) {
    const Lanes p = lanes_at(pressure, i), e = lanes_at(elastic, i), ep = lanes_at(plastic, i);
    set_lanes(bulk_modulus, i, model.rate_modulus(p, e, ep));
  }
}

/// The elastic strain at which the state form has this pressure.
template <ElasticModel Model>
double elastic_volumetric_at(const Model& model, double pressure, double plastic)
{
  // Beyond the range the pressure goes on with a positive modulus, so that doubling finds a bracket.
  double width = std::max(model.range().most_elastic, 1e-3);
  double low = 0, high = 0;
  while (model.at(high, plastic).pressure < pressure) high += width, width *= 2;
  while (model.at(low, plastic).pressure > pressure) low -= width, width *= 2;
  double e = 0.5 * (low + high);
  for (int i = 0; i < 200 && low < high; ++i) {
    const ElasticPoint point = model.at(e, plastic);
    const double excess = point.pressure - pressure;
    (excess < 0 ? low : high) = e;
    if (std::abs(excess) <= 1e-14 * std::abs(pressure)) break;
    const double newton = e - excess / point.bulk_modulus;
    const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
    if (next == e) break;
    e = next;
  }
  return e;
}

}  // namespace tamp::components
