#pragma once

#include <variant>

#include "components/choice.hpp"
#include "components/shapes/cpdi.hpp"
#include "components/shapes/cpgimp.hpp"
#include "components/shapes/cubic_spline.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/linear.hpp"

/// Members of every interpolator of D dimensions; docs/explanation/method.md says what each is for:
///
///  - `word`, its name in scenes, and `meaning`, its weights, for people;
///  - a constructor from the number of particles along each axis of a cell;
///  - its weights: along an axis, where they are products of axes (product_shape.hpp), or at the nodes of a block
///    (dense_stencil.hpp);
///  - `reach()`, the distance in cells along an axis from a particle to the furthest node it can reach, at most 2;
///  - `greatest_stiffness_along_axis()`, see own_stiffness.hpp; infinity for none;
///  - `deforms`, whether a particle's domain deforms with it, so that neighbours never part;
///  - `is_spline`, whether a particle's weights do not know its size and change smoothly.
namespace tamp::components
{

/// All the interpolators there are; one more is added here.
template <int D>
using Shapes = std::variant<Linear<D>, Gimp<D>, Cpgimp<D>, Cpdi<D>, QuadraticSpline<D>, CubicSpline<D>>;

/// How the weights of nodes follow from a particle's place.
using Interpolator = Choice<Shapes<1>>;

/// Calls `visit(shape)` with the weights of an interpolator for `n_per_axis` particles along each axis of a cell.
template <int D, class Visit>
auto with_shape(Interpolator interpolator, int n_per_axis, Visit&& visit)
{
  return with_alternative<Shapes<D>>(static_cast<std::size_t>(static_cast<int>(interpolator)),
                                     [&]<class Shape>(std::type_identity<Shape>) { return visit(Shape(n_per_axis)); });
}

/// Layers of nodes that a particle reaches beyond the nodes of its cell.
constexpr int n_layers_beyond(Interpolator)
{
  return 1;
}

/// Distance in cells along an axis from a particle to the furthest node it can reach.
inline double reach(Interpolator interpolator, int n_per_axis)
{
  return with_shape<1>(interpolator, n_per_axis, [](const auto& shape) -> double { return shape.reach(); });
}

/// Whether weights reach more than one node along every axis wherever the particle is, so that they have second
/// moments, which `apic` divides by.
inline bool has_second_moments(Interpolator interpolator)
{
  return reach(interpolator, 1) > 1;
}

}  // namespace tamp::components
