#pragma once

#include <Eigen/Core>
#include <vector>

#include "components/shapes/grid_block.hpp"
#include "components/shapes/interpolator.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Layers of equal particles along one axis, on the nodes along that axis.
struct LayerColumn {
  /// All nodes of the domain and a ghost node beyond each end; mirroring walls are at the second node and the last but
  /// one.
  GridBlock<1> nodes;
  bool lower_wall;
  bool upper_wall;
  /// Middles of the layers [m], ascending and `spacing` apart. They reach to the walls there are.
  std::vector<double> layers;
  double spacing;
  /// Density of each layer [kg/m^3]; between two walls all layers have the same.
  std::vector<double> density;

  /// The end that is no wall [m]; of a column between walls, its upper end.
  double free_end() const
  {
    return upper_wall && !lower_wall ? layers.front() - 0.5 * spacing : layers.back() + 0.5 * spacing;
  }
};

/// A body force per mass [m/s^2] along an axis: value + slope x.
struct LinearForce {
  double value;
  double slope;

  double at(double x) const { return value + slope * x; }
  double integral(double x) const { return x * (value + 0.5 * slope * x); }
};

/// The stress of the column that solves sigma' + rho b = 0 without a grid: from zero at the free end, or, between two
/// walls, with a mean of zero.
Eigen::VectorXd continuum_stress(const LayerColumn& column, const LinearForce& force);

/// Stress of each layer along the column's axis [Pa, tension positive] under which every free node is at rest to
/// round-off: the internal force of all layers together balances the body force at the node's place on the node's mass,
/// mirror images counted. Of all such stresses it is the one nearest to that of the continuum. Where bodies fill whole
/// walls of a box, layers of three such columns across each other are at rest in the plane and in space too, as weights
/// are products of weights along the axes.
std::vector<double> settled_stress(Interpolator interpolator, int n_per_axis, const LayerColumn& column,
                                   const LinearForce& force);

}  // namespace tamp::components
