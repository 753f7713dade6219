#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

#include "components/portable_math.hpp"
#include "components/shapes/grid_block.hpp"
#include "components/shapes/stencil.hpp"
#include "components/tensors.hpp"

/// The plane at a grid node that best parts the particles of two materials, by logistic regression, and how far the
/// materials are apart along its normal (after Nairn, Hammerquist & Smith, CMAME 362, 2020, 112859). All of it comes
/// from sums over the particles of one material at a time, so that patches may add their parts. Lengths are in cells
/// and seen from the node.
namespace tamp::components
{

/// At one node, as one of the two materials sees it; all zero where no two materials are to be parted.
template <int D>
struct ContactPlane {
  /// -1: this material is the first of the pair, the normal points out of it. +1: the second.
  std::int8_t side = 0;
  /// Whether a particle whose stencil starts here reaches a node with a plane.
  bool starts_near = false;
  /// (n, d): n . x + d is negative in the first material. The longer n, the sharper the materials are parted.
  Vector<D + 1> coefficients = Vector<D + 1>::Zero();

  Vector<D> normal() const { return coefficients.template head<D>().normalized(); }

  void hold_on_mirror(int axis) { coefficients[axis] = 0; }
  ContactPlane mirrored(int axis) const
  {
    ContactPlane image = *this;
    image.coefficients[axis] = -coefficients[axis];
    return image;
  }
};

/// Parts of the particles of one material in gradient and Hessian of the cost sum_p w_p log(1 + exp(-y_p z_p . phi))
/// with z = (x, 1), y = -1 in the first material and +1 in the second. Weights w are the roots of S_ip: more
/// even, they see more of the surface than S_ip itself, and still fade in and out as particles move.
template <int D>
struct RegressionSums {
  Vector<D + 1> gradient = Vector<D + 1>::Zero();
  /// Its lower triangle alone is used.
  Matrix<D + 1> hessian = Matrix<D + 1>::Zero();
  /// sum w_p
  double weight = 0;

  /// `shape` is S_ip of the particle.
  void add(const ContactPlane<D>& plane, double shape, const Vector<D>& x)
  {
    Vector<D + 1> z;
    z << x, 1;
    const double w = std::sqrt(shape);
    // The fit's probability that the particle lies on the other side.
    const double other_side = 1 / (1 + portable::exp(plane.side * z.dot(plane.coefficients)));
    weight += w;
    gradient -= w * plane.side * other_side * z;
    hessian += w * other_side * (1 - other_side) * z * z.transpose();
  }

  RegressionSums& operator+=(const RegressionSums& other)
  {
    gradient += other.gradient;
    hessian += other.hessian;
    weight += other.weight;
    return *this;
  }
  void hold_on_mirror(int axis)
  {
    const double own = hessian(axis, axis);
    gradient[axis] = 0;
    hessian.row(axis).setZero();
    hessian.col(axis).setZero();
    hessian(axis, axis) = own;
  }
  RegressionSums mirrored(int axis) const
  {
    RegressionSums image = *this;
    image.gradient[axis] = -gradient[axis];
    image.hessian.row(axis) *= -1;
    image.hessian.col(axis) *= -1;
    return image;
  }
};

/// One step of Newton's method towards the least cost, in which both materials weigh the same and a ridge bounds n.
/// From no plane at all the first step is Fisher's linear discriminant.
template <int D>
Vector<D + 1> newton_step(const Vector<D + 1>& plane, const RegressionSums<D>& first, const RegressionSums<D>& second);

/// Sums over the particles of one material that tell where it ends along its outward normal. Weights are S_ip itself:
/// what counts is the edge beside the node. The more even they are, the further beside the place where it touches a
/// round body seems to touch too, which keeps it from rolling; the narrower, the more the edge jitters.
template <int D>
struct EdgeSums {
  double weight = 0;
  double moment = 0;

  /// Particles of edge `size`. Of many layers, each a size behind the one before, the outermost has the say.
  void add(const ContactPlane<D>& plane, double shape, const Vector<D>& x, double size)
  {
    const double place = -plane.side * x.dot(plane.normal());
    const double say = shape * portable::exp(sharpness / size * place);
    weight += say;
    moment += say * place;
  }
  /// Exact for layers of particles up to the edge. An edge that cuts through the layers seems to be 0.22 sizes further
  /// out, as the particles along it reach out by up to half their size.
  double edge(double size) const { return moment / weight + 0.5 * size / portable::tanh(0.5 * sharpness); }

  EdgeSums& operator+=(const EdgeSums& other)
  {
    weight += other.weight;
    moment += other.moment;
    return *this;
  }
  void hold_on_mirror(int) {}
  EdgeSums mirrored(int) const { return *this; }

  /// The weight falls by exp(-sharpness) from layer to layer.
  static constexpr double sharpness = 3;
};

/// Marks where the stencils of `support` nodes an axis start that reach a node with a plane.
template <int D>
void mark_starts(const GridBlock<D>& block, int support, ContactPlane<D>* planes);

/// Calls `visit(node, S_ip, x)` for every particle and every node with a plane that it reaches, x being the particle
/// seen from the node.
template <class Interpolator, int D = Interpolator::dimension, class Visit>
void for_each_parted(const Interpolator& interpolator, const GridBlock<D>& block, const ContactPlane<D>* planes,
                     const ParticlePlaces<D>& places, Visit&& visit)
{
  for_each_stencil(interpolator, block, places, [&](std::size_t p, const auto& stencil) {
    if (!planes[stencil.first].starts_near) return;
    const Vector<D> place = block.in_cells(places.position[p]);
    for_each_weight(block, stencil, [&](std::ptrdiff_t node, double shape) {
      if (planes[node].side == 0 || !(shape > 0)) return;
      visit(node, shape, Vector<D>(place - block.cells_to(node)));
    });
  });
}

}  // namespace tamp::components
