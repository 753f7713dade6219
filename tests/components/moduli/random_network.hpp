#pragma once

#include <cmath>
#include <cstddef>
#include <random>
#include <vector>

#include "components/moduli/network_fit.hpp"

namespace random_network
{

/// Layers of these widths, the inputs' among them. Weights are between -1 and 1, over the square root of the number of
/// a layer's inputs; equal widths have equal weights.
inline std::vector<tamp::components::DenseLayer> layers(const std::vector<std::size_t>& widths,
                                                        tamp::components::Activation hidden,
                                                        tamp::components::Activation output)
{
  std::mt19937 random(static_cast<unsigned>(widths.size() + widths[1]));
  std::uniform_real_distribution<double> weight(-1, 1);
  std::vector<tamp::components::DenseLayer> made;
  for (std::size_t l = 1; l < widths.size(); ++l) {
    const std::size_t n_inputs = widths[l - 1], n_outputs = widths[l];
    made.push_back({l + 1 < widths.size() ? hidden : output, n_inputs, n_outputs, {}, {}});
    for (std::size_t i = 0; i < n_inputs * n_outputs; ++i) {
      made.back().kernel.push_back(weight(random) / std::sqrt(static_cast<double>(n_inputs)));
    }
    for (std::size_t o = 0; o < n_outputs; ++o) made.back().bias.push_back(weight(random));
  }
  return made;
}

}  // namespace random_network
