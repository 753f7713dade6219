#pragma once

#include <stdexcept>

#include "components/shapes/cpdi.hpp"
#include "components/shapes/cpgimp.hpp"
#include "components/shapes/cubic_spline.hpp"
#include "components/shapes/gimp.hpp"
#include "components/shapes/interpolation.hpp"
#include "components/shapes/linear.hpp"

namespace tamp::components
{

/// Calls `visit(shape)` with the weights of an interpolator for `n_per_axis` particles along each axis of a cell: the
/// one list of all interpolators.
template <int D, class Visit>
auto with_shape(Interpolator interpolator, int n_per_axis, Visit&& visit)
{
  switch (interpolator) {
    case Interpolator::linear:
      return visit(Linear<D>());
    case Interpolator::gimp:
      return visit(Gimp<D>(n_per_axis));
    case Interpolator::cpgimp:
      return visit(Cpgimp<D>(n_per_axis));
    case Interpolator::cpdi:
      return visit(Cpdi<D>(n_per_axis));
    case Interpolator::quadratic_spline:
      return visit(Gimp<D>::quadratic_spline());
    case Interpolator::cubic_spline:
      return visit(CubicSpline<D>());
  }
  throw std::logic_error("unknown interpolator");
}

}  // namespace tamp::components
