#pragma once

#include <random>

#include "components/moduli/support_vector_fit.hpp"

/// A fit with vectors on a jittered grid around the box, total strains -10 to 45 % and plastic ones 0 to 32 %. Its
/// pressure rises about as the square of the scaled total strain's distance from where it turns.
inline tamp::components::SupportVectorFit jittered_fit(double gamma, double turns_at = -0.5)
{
  tamp::components::SupportVectorFit fit{
      {0.01, -10, 45, 1 / 55.0}, {0.01, 0, 32, 1 / 32.0}, 1e6, 2e-2, -10, gamma, -0.4, {}, {}};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> jitter(-0.02, 0.02);
  for (int i = 0; i < 18; ++i) {
    for (int j = 0; j < 17; ++j) {
      const double total = -0.4 + 0.1 * i + jitter(random), plastic = -0.4 + 0.11 * j + jitter(random);
      fit.vectors.push_back({total, plastic});
      fit.coefficients.push_back((total - turns_at) * (total - turns_at) * (1 + plastic) * (1 + jitter(random)));
    }
  }
  return fit;
}
