#pragma once

#include <array>
#include <cstdint>

#include "components/lanes.hpp"
#include "components/portable_math.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/tensors.hpp"

/// The plane at a grid node that best parts the particles of two materials, by logistic regression, and how far the
/// materials are apart along its normal (after Nairn, Hammerquist & Smith, CMAME 362, 2020, 112859). All of it comes
/// from sums over the particles of one material at a time, so that patches may add their parts. Lengths are in cells
/// and seen from the node.
namespace tamp::components
{

/// The plane at one node, as one of the two materials sees it; all zero where no two materials are to be parted.
template <int D>
struct ContactPlane {
  /// -1: this material is the first of the pair, the normal points out of it. +1: the second.
  std::int8_t side = 0;
  /// Whether a particle in the cell that begins here may reach a node with a plane.
  bool is_near_cell = false;
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

/// A particle seen from a node with a plane. Number is double, or Lanes for as many particles and nodes.
template <int D, class Number>
struct PartedParticle {
  /// Side and coefficients of the plane, as the particle's material sees it.
  Number side;
  Vector<D + 1, Number> coefficients;
  /// S_ip
  Number shape;
  Vector<D, Number> x;
};

/// Parts of the particles of one material in gradient and Hessian of the cost sum_p w_p log(1 + exp(-y_p z_p . phi))
/// with z = (x, 1), y = -1 in the first material and +1 in the second. Weights w are the roots of S_ip: more
/// even, they see more of the surface than S_ip itself, and still fade in and out as particles move.
template <int D>
struct RegressionSums : NodeValues<D, D == 2 ? 12 : 16, 1> {
  static constexpr int n = D + 1;
  static constexpr int at_gradient = 1, at_hessian = 1 + n, n_used = at_hessian + n * (n + 1) / 2;
  template <class Number>
  using Share = std::array<Number, n_used>;

  /// sum w_p
  double weight() const { return this->values[0]; }
  Vector<n> gradient() const { return this->values.template segment<n>(at_gradient).matrix(); }
  /// Its lower triangle alone.
  Matrix<n> hessian() const
  {
    Matrix<n> lower = Matrix<n>::Zero();
    for_each_of_hessian([&](int at, int i, int k) { lower(i, k) = this->values[at]; });
    return lower;
  }

  /// The share that a particle adds to the values.
  template <class Number>
  static Share<Number> share(const PartedParticle<D, Number>& particle)
  {
    Vector<n, Number> z;
    z << particle.x, Number(1.0);
    const Number w = sqrt(particle.shape);
    const Number odds = particle.side * z.dot(particle.coefficients);
    // The fit's probability that the particle lies on the other side: even where there is no plane yet.
    const Number other_side = any(odds != 0.0) ? Number(1.0 / (1.0 + portable::exp(odds))) : Number(0.5);
    const Number slope = w * particle.side * other_side, curvature = w * other_side * (1.0 - other_side);
    Share<Number> share;
    share[0] = w;
    for (int k = 0; k < n; ++k) share[static_cast<std::size_t>(at_gradient + k)] = -(slope * z[k]);
    for_each_of_hessian([&](int at, int i, int k) { share[static_cast<std::size_t>(at)] = curvature * z[i] * z[k]; });
    return share;
  }

  RegressionSums& operator+=(const RegressionSums& other)
  {
    this->values += other.values;
    return *this;
  }
  void hold_on_mirror(int axis)
  {
    for_each_across(axis, [](double& value) { value = 0; });
  }
  RegressionSums mirrored(int axis) const
  {
    RegressionSums image = *this;
    image.for_each_across(axis, [](double& value) { value *= -1; });
    return image;
  }

 private:
  /// Calls `visit(at, i, k)` for element (i, k) of the lower triangle of the Hessian, which is the value number `at`.
  template <class Visit>
  static constexpr void for_each_of_hessian(const Visit& visit)
  {
    int at = at_hessian;
    for (int k = 0; k < n; ++k) {
      for (int i = k; i < n; ++i) visit(at++, i, k);
    }
  }
  /// The values that a mirror normal to `axis` turns round.
  template <class Visit>
  void for_each_across(int axis, const Visit& visit)
  {
    visit(this->values[at_gradient + axis]);
    for_each_of_hessian([&](int at, int i, int k) {
      if ((i == axis) != (k == axis)) visit(this->values[at]);
    });
  }
};

/// Takes a step of Newton's method towards the least cost, in which both materials weigh the same and a ridge bounds n.
/// From no plane at all the first step is Fisher's linear discriminant.
template <int D>
Vector<D + 1> newton_step(const Vector<D + 1>& plane, const RegressionSums<D>& first, const RegressionSums<D>& second);

/// Sums over the particles of one material that tell where it ends along its outward normal. Weights are S_ip itself:
/// what counts is the edge beside the node. The more even they are, the further beside the place where it touches a
/// round body seems to touch too, which keeps it from rolling; the narrower, the more the edge jitters.
template <int D>
struct EdgeSums {
  template <class Number>
  using Share = std::array<Number, 2>;

  double weight = 0;
  double moment = 0;

  /// The share that a particle of edge `size` adds to weight and moment. Among many layers, each a size behind the one
  /// before, the outermost decides.
  template <class Number>
  static Share<Number> share(const PartedParticle<D, Number>& particle, double size)
  {
    const Vector<D, Number> n = particle.coefficients.template head<D>();
    const Number square = n.squaredNorm(), length = select(square > 0.0, Number(sqrt(square)), Number(1.0));
    const Number place = -particle.side * particle.x.dot(n / length);
    const Number say = particle.shape * portable::exp(Number(sharpness / size * place));
    return {say, say * place};
  }
  /// Exact for layers of particles up to the edge. An edge that cuts through the layers seems to be 0.22 sizes further
  /// out, as the particles along it reach out by up to half their size.
  double edge(double size) const
  {
    static const double from_centre = portable::tanh(0.5 * sharpness);
    return moment / weight + 0.5 * size / from_centre;
  }

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

}  // namespace tamp::components
