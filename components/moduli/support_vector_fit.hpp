#pragma once

#include <array>
#include <vector>

namespace tamp::components
{

/// The numbers of a fitted support-vector regression of pressure, as its file has them (the published layout, Vaango).
/// Inputs are total and plastic volumetric strain, compression positive:
///     x_i = (strain_i / unit - lower) scale,
///     pressure = pressure_unit ((sum_j a_j exp(-gamma |s_j - x|^2) + intercept) / pressure_scale + pressure_lower).
struct SupportVectorFit {
  struct Input {
    double unit;  ///< 0.01 for strains in percent
    double lower, upper;
    double scale;
  };
  Input total, plastic;
  double pressure_unit;  ///< Pa
  double pressure_scale, pressure_lower;
  double gamma;
  double intercept;
  std::vector<std::array<double, 2>> vectors;  ///< s_j: (total, plastic), scaled
  std::vector<double> coefficients;            ///< a_j
};

}  // namespace tamp::components
