#include "components/loads/settled_stress.hpp"

#include <Eigen/QR>
#include <cstddef>

namespace tamp::components
{

Eigen::VectorXd continuum_stress(const LayerColumn& column, const LinearForce& force)
{
  const auto n = static_cast<Eigen::Index>(column.layers.size());
  const Eigen::VectorXd integral = Eigen::Map<const Eigen::VectorXd>(column.layers.data(), n).unaryExpr([&](double at) {
    return force.integral(at);
  });
  const auto density = [&](Eigen::Index l) { return column.density[static_cast<std::size_t>(l)]; };
  const bool between_walls = column.lower_wall && column.upper_wall, hangs = column.upper_wall && !column.lower_wall;
  Eigen::VectorXd stress(n);
  // From the free end on; `end` is where the layers of this density begin, and `carried` the stress there.
  double end = between_walls ? integral.mean() : force.integral(column.free_end()), carried = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Index l = hangs ? i : n - 1 - i, before = hangs ? l - 1 : l + 1;
    if (i > 0 && density(l) != density(before)) {
      const double edge =
          0.5 * (column.layers[static_cast<std::size_t>(l)] + column.layers[static_cast<std::size_t>(before)]);
      carried += density(before) * (end - force.integral(edge));
      end = force.integral(edge);
    }
    stress[l] = carried + density(l) * (end - integral[l]);
  }
  return stress;
}

namespace
{

/// Weights of layers at nodes, and their slopes [1/m].
struct LayerWeights {
  Eigen::MatrixXd weight, slope;
};

template <class Shape>
LayerWeights layer_weights(const Shape& shape, const LayerColumn& column)
{
  const auto n_layers = static_cast<Eigen::Index>(column.layers.size());
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(column.nodes.n_nodes[0], n_layers);
  LayerWeights weights{none, none};
  for (Eigen::Index l = 0; l < n_layers; ++l) {
    const Vector<1> x(column.layers[static_cast<std::size_t>(l)]);
    const auto set = [&](std::ptrdiff_t node, double w, double s) {
      weights.weight(node, l) = w;
      weights.slope(node, l) = s;
    };
    if constexpr (Dense<Shape>) {
      for_each_node(column.nodes, shape.at(column.nodes, x, Matrix<1>::Identity()),
                    [&](std::ptrdiff_t node, double w, const Vector<1>& gradient) { set(node, w, gradient[0]); });
    } else {
      const auto stencil = shape.at(column.nodes, x);
      for (std::size_t k = 0; k < stencil.weight[0].size(); ++k) {
        set(stencil.first + static_cast<std::ptrdiff_t>(k), stencil.weight[0][k], stencil.slope[0][k]);
      }
    }
  }
  return weights;
}

}  // namespace

std::vector<double> settled_stress(Interpolator interpolator, int n_per_axis, const LayerColumn& column,
                                   const LinearForce& force)
{
  LayerWeights weights =
      with_shape<1>(interpolator, n_per_axis, [&](const auto& shape) { return layer_weights(shape, column); });
  Eigen::MatrixXd &weight = weights.weight, &slope = weights.slope;
  const Eigen::Index last = column.nodes.n_nodes[0] - 1;
  const auto fold = [&](Eigen::Index ghost, Eigen::Index inside) {
    weight.row(inside) += weight.row(ghost);
    slope.row(inside) -= slope.row(ghost);
  };
  if (column.lower_wall) fold(0, 2);
  if (column.upper_wall) fold(last, last - 2);

  // As parts of the first layer's mass.
  const double density = column.density.front();
  const Eigen::Map<const Eigen::VectorXd> densities(column.density.data(), weight.cols());
  const Eigen::MatrixXd mass = weight * (densities / density).asDiagonal();

  // sum sigma dS = b sum rho S at each node that is accelerated; a node that an edge touches to round-off is not.
  constexpr double least_weight = 1e-24;
  std::vector<Eigen::Index> free;
  for (Eigen::Index i = column.lower_wall ? 2 : 0; i <= (column.upper_wall ? last - 2 : last); ++i) {
    if (weight.row(i).sum() > least_weight) free.push_back(i);
  }
  const Eigen::MatrixXd balance = slope(free, Eigen::all);
  Eigen::VectorXd load(static_cast<Eigen::Index>(free.size()));
  for (std::size_t i = 0; i < free.size(); ++i) {
    const double x = column.nodes.origin[0] + static_cast<double>(free[i]) * column.nodes.cell_size;
    load[static_cast<Eigen::Index>(i)] = density * force.at(x) * mass.row(free[i]).sum();
  }

  const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> least_norm(balance);
  Eigen::VectorXd stress = continuum_stress(column, force);
  // The second pass takes off the round-off of the first.
  for (int pass = 0; pass < 2; ++pass) stress += least_norm.solve(load - balance * stress);
  return {stress.begin(), stress.end()};
}

}  // namespace tamp::components
