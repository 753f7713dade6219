#pragma once

#include "tests/tools/scene/keras_file.hpp"

/// Models small enough to be worked out by hand.
namespace tamp::test
{

/// Elastic and plastic strain to K, with every kind of activation. K rises with both strains.
inline const KerasFile small_network{.layers = {{"first", "relu", 2, 2, {0.7, 0.1, 0.2, 0.9}, {0.3, -0.1}},
                                                {"second", "sigmoid", 2, 2, {1.1, 0.4, 0.5, 0.8}, {0.1, 0.2}},
                                                {"third", "tanh", 2, 2, {0.6, 0.2, 0.3, 0.7}, {-0.2, 0.1}},
                                                {"last", "linear", 2, 1, {1.5, 0.5}, {-0.3}}},
                                     .scaling = {0.03, 0.05, 0.2, 0.15, 2e10, 1e10},
                                     .range = {0, 0.1, 0, 0.3}};

/// Pressure of total and plastic strain, in percent and MPa as published. K is positive everywhere.
inline constexpr const char* small_regression = R"json({
  "X_var": ["Total volumetric strain (%)", "Plastic volumetric strain (%)"], "y_var": "Pressure (MPa)",
  "X_conversion_factor": [0.01, 0.01], "y_conversion_factor": 1e6,
  "X_scale": [0.02, 0.04], "X_min": [-10, 0], "X_max": [40, 25],
  "y_scale": [1e-3], "y_min": [-200], "y_max": [800],
  "gamma": 0.5, "intercept": [0.4],
  "support_vectors": [[1.2, 0], [1.1, 1], [-0.1, 0.5]],
  "dual_coeffs": [[1, 0.5, -0.25]]
})json";

}  // namespace tamp::test
