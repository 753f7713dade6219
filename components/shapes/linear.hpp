#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "components/lanes.hpp"
#include "components/shapes/product_shape.hpp"

namespace tamp::components
{

/// Linear functions at the particle's place (Sulsky, Chen & Schreyer 1994): 2 nodes an axis. Gradients jump where
/// particles cross cells, and the force on a node that is hardly reached is finite while its mass vanishes.
template <int D>
class Linear : public ProductShape<Linear<D>, D, 2>
{
 public:
  static constexpr std::string_view word = "linear";
  static constexpr std::string_view meaning =
      "the functions of the grid at a point, which need the time step's rule `\"published\"`";
  static constexpr bool deforms = false;

  explicit Linear(int /*n_per_axis*/) {}

  /// No bound: the squared slope stays while the weight vanishes.
  double greatest_stiffness_along_axis() const { return std::numeric_limits<double>::infinity(); }

  template <class Number>
  Number along(const Number& place, const Number& /*cell*/, const Number& /*stretch*/, double per_cell,
               std::array<Number, 2>& w, std::array<Number, 2>& s) const
  {
    // On a node there is a next one still, whose mass is too little to be moved by forces: that it goes with the
    // particle keeps an edge of a body from being stretched towards a node at rest.
    constexpr double hardly = 1e-30;
    const Number node = floor(place);
    w[1] = greater_of(place - node, Number(hardly));
    w[0] = 1.0 - w[1];
    s[0] = -per_cell;
    s[1] = per_cell;
    return node;
  }
};

}  // namespace tamp::components
