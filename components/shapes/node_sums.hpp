#pragma once

#include <array>
#include <experimental/simd>

#include "components/tensors.hpp"

namespace tamp::components
{

/// Four numbers worked on side by side.
using Quad = std::experimental::simd<double, std::experimental::simd_abi::deduce_t<double, 4>>;

inline Quad quad(double a, double b, double c, double d)
{
  const std::array<double, 4> values{a, b, c, d};
  return Quad([&](auto i) { return values[i]; });
}

/// The numbers of a node, with the vectors among them, which begin at `first_of_vectors`. Kernels take them four at a
/// time, so that numbers which are worked on alike stand in one four.
template <int D, int n_values, int... first_of_vectors>
struct alignas(4 * sizeof(double)) NodeValues {
  static_assert(n_values % 4 == 0);

  Eigen::Array<double, n_values, 1> values = Eigen::Array<double, n_values, 1>::Zero();

  Vector<D> vector(int first) const { return values.template segment<D>(first).matrix(); }
  void set_vector(int first, const Vector<D>& vector) { values.template segment<D>(first) = vector.array(); }

  /// The values from `first` on.
  Quad four(int first) const { return Quad(values.data() + first, std::experimental::element_aligned); }
  void add(int first, const Quad& share)
  {
    (four(first) + share).copy_to(values.data() + first, std::experimental::element_aligned);
  }

  /// On a mirror normal to `axis` the image brings the opposite of every normal component.
  void hold_on_mirror(int axis) { ((values[first_of_vectors + axis] = 0), ...); }
  /// Turns the vectors into their images in a mirror normal to `axis`.
  void mirror(int axis) { ((values[first_of_vectors + axis] *= -1), ...); }
};

/// Sums over the particles at a node: mass and momentum with the weights of particles, and from the second four on what
/// goes with the derivatives of weights.
template <int D>
struct NodeSums : NodeValues<D, D == 2 ? 8 : 12, 1, 4, 4 + D> {
  static constexpr int at_force = 4, at_surface = 4 + D;

  /// sum m_p S_ip [kg]
  double mass() const { return this->values[0]; }
  /// sum m_p v_p S_ip [kg m/s]
  Vector<D> momentum() const { return this->vector(1); }
  /// -sum V_p (sigma_p - q_p I) . grad S_ip [N], and what loads on the particles add to it.
  Vector<D> internal_force() const { return this->vector(at_force); }
  void add_force(const Vector<D>& force) { this->set_vector(at_force, internal_force() + force); }
  /// sum V_p grad S_ip [m^(D-1)]: points out of the material at its surface, vanishes within. 0 where nothing asks for
  /// it.
  Vector<D> surface_gradient() const { return this->vector(at_surface); }
  void set_surface_gradient(const Vector<D>& gradient) { this->set_vector(at_surface, gradient); }

  NodeSums& operator+=(const NodeSums& other)
  {
    this->values += other.values;
    return *this;
  }
  NodeSums mirrored(int axis) const
  {
    NodeSums image = *this;
    image.mirror(axis);
    return image;
  }
};

/// How a node moves through a step.
template <int D>
struct NodeMotion : NodeValues<D, D == 2 ? 4 : 8, 0, D == 2 ? 2 : 4> {
  static constexpr int at_change = D == 2 ? 2 : 4;

  /// Velocity at the middle of the step [m/s].
  Vector<D> velocity() const { return this->vector(0); }
  /// Its change from the middle of the step before [m/s]: what particles take from it.
  Vector<D> velocity_change() const { return this->vector(at_change); }

  void set(const Vector<D>& velocity, const Vector<D>& change)
  {
    this->set_vector(0, velocity);
    this->set_vector(at_change, change);
  }
  NodeMotion mirrored(int axis) const
  {
    NodeMotion image = *this;
    image.mirror(axis);
    return image;
  }
};

/// A vector at a node, or the sum of what particles bring of one.
template <int D>
struct NodeVector : NodeValues<D, 4, 0> {
  Vector<D> value() const { return this->vector(0); }
  void set(const Vector<D>& value) { this->set_vector(0, value); }

  NodeVector& operator+=(const NodeVector& other)
  {
    this->values += other.values;
    return *this;
  }
  NodeVector mirrored(int axis) const
  {
    NodeVector image = *this;
    image.mirror(axis);
    return image;
  }
};

}  // namespace tamp::components
