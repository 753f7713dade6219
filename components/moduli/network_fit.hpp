#pragma once

#include <cstddef>
#include <vector>

#include "components/moduli/elastic_model.hpp"

namespace tamp::components
{

enum class Activation { linear, relu, sigmoid, tanh };

/// y = activation(x kernel + bias)
struct DenseLayer {
  Activation activation;
  std::size_t n_inputs, n_outputs;
  std::vector<double> kernel;  ///< [input][output], as Keras stores it
  std::vector<double> bias;
};

/// Standardised: (value - mean) / deviation; a deviation of 0 counts as 1.
struct Scaling {
  double mean, deviation;
};

/// The numbers of a fitted network for the bulk modulus: two inputs, elastic and plastic volumetric strain (compression
/// positive), one output, K; each standardised.
struct NetworkFit {
  std::vector<DenseLayer> layers;
  Scaling elastic, plastic, bulk_modulus;
  StrainRange range;  ///< the strains that it was fitted over
};

}  // namespace tamp::components
