#pragma once

namespace tamp::components
{

/// How the weights of nodes follow from a particle's place; docs/method.md says what each is for.
enum class Interpolator { gimp, quadratic_spline };

/// Layers of nodes that a particle reaches beyond the nodes of its cell.
constexpr int n_layers_beyond(Interpolator)
{
  return 1;
}

/// Distance in cells along an axis from a particle to the furthest node it can reach, for `n_per_axis` particles along
/// each axis of a cell.
constexpr double reach(Interpolator interpolator, int n_per_axis)
{
  return interpolator == Interpolator::gimp ? 1 + 0.5 / n_per_axis : 1.5;
}

}  // namespace tamp::components
