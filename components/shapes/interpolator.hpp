#pragma once

namespace tamp::components
{

/// How the weights of nodes follow from a particle's place; docs/method.md says what each is for.
enum class Interpolator { linear, gimp, cpgimp, cpdi, quadratic_spline, cubic_spline };

/// Layers of nodes that a particle reaches beyond the nodes of its cell.
constexpr int n_layers_beyond(Interpolator)
{
  return 1;
}

/// Whether weights reach more than one node along every axis wherever the particle is, so that they have second
/// moments, which `apic` divides by.
constexpr bool has_second_moments(Interpolator interpolator)
{
  return interpolator != Interpolator::linear;
}

/// Distance in cells along an axis from a particle to the furthest node it can reach, for `n_per_axis` particles along
/// each axis of a cell.
constexpr double reach(Interpolator interpolator, int n_per_axis)
{
  switch (interpolator) {
    case Interpolator::linear:
      return 1;
    case Interpolator::gimp:
      return 1 + 0.5 / n_per_axis;
    case Interpolator::quadratic_spline:
      return 1.5;
    default:
      return 2;
  }
}

}  // namespace tamp::components
