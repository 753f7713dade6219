#include "tools/bench/plain_moduli.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace tamp::tools::bench
{

namespace
{

using components::Activation;
using components::DenseLayer;
using components::Scaling;
using components::SupportVectorFit;

double scaled(const SupportVectorFit::Input& input, double strain)
{
  return (strain / input.unit - input.lower) * input.scale;
}

double standardised(const Scaling& scaling, double value)
{
  return (value - scaling.mean) / (scaling.deviation == 0 ? 1 : scaling.deviation);
}

double activated(Activation activation, double x)
{
  switch (activation) {
    case Activation::relu:
      return std::max(x, 0.0);
    case Activation::sigmoid:
      return 1 / (1 + std::exp(-x));
    case Activation::tanh:
      return std::tanh(x);
    case Activation::linear:
      break;
  }
  return x;
}

}  // namespace

components::ElasticPoint plain_support_vectors(const SupportVectorFit& fit, double elastic, double plastic)
{
  const double x = scaled(fit.total, elastic + plastic), y = scaled(fit.plastic, plastic);
  double sum = 0, by_x = 0, by_y = 0;
  for (std::size_t j = 0; j < fit.vectors.size(); ++j) {
    const double dx = fit.vectors[j][0] - x, dy = fit.vectors[j][1] - y;
    const double term = fit.coefficients[j] * std::exp(-fit.gamma * (dx * dx + dy * dy));
    sum += term;
    by_x += 2 * fit.gamma * dx * term;
    by_y += 2 * fit.gamma * dy * term;
  }
  const double unit = fit.pressure_unit / fit.pressure_scale;
  const double by_total = unit * by_x * fit.total.scale / fit.total.unit;
  return {unit * (sum + fit.intercept) + fit.pressure_unit * fit.pressure_lower, by_total,
          by_total + unit * by_y * fit.plastic.scale / fit.plastic.unit};
}

double plain_network(const components::NetworkFit& fit, double elastic, double plastic)
{
  std::vector<double> values{standardised(fit.elastic, elastic), standardised(fit.plastic, plastic)};
  std::vector<double> next;
  for (const DenseLayer& layer : fit.layers) {
    next.assign(layer.n_outputs, 0);
    for (std::size_t i = 0; i < layer.n_outputs; ++i) {
      double sum = layer.bias[i];
      for (std::size_t j = 0; j < layer.n_inputs; ++j) sum += values[j] * layer.kernel[j * layer.n_outputs + i];
      next[i] = activated(layer.activation, sum);
    }
    values.swap(next);
  }
  return fit.bulk_modulus.mean + values[0] * (fit.bulk_modulus.deviation == 0 ? 1 : fit.bulk_modulus.deviation);
}

}  // namespace tamp::tools::bench
