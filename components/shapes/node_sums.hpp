#pragma once

#include <array>

#include "components/tensors.hpp"

namespace tamp::components
{

/// What particles give to a node. The values of a node stand together, in whole vector registers (8 or 12 doubles),
/// so that one particle's share is added with a few wide operations.
template <int D>
struct NodeSums {
  static constexpr int n_values = D == 2 ? 8 : 12;
  using Values = Eigen::Array<double, n_values, 1>;

  Values values = Values::Zero();

  /// sum m_p S_ip [kg]
  double mass() const { return values[0]; }
  /// sum m_p v_p S_ip [kg m/s]
  Vector<D> momentum() const { return values.template segment<D>(1).matrix(); }
  void add_momentum(const Vector<D>& momentum) { values.template segment<D>(1) += momentum.array(); }
  /// -sum V_p (sigma_p - q_p I) . grad S_ip [N]
  Vector<D> internal_force() const { return values.template segment<D>(1 + D).matrix(); }
  /// sum V_p grad S_ip [m^(D-1)]: points out of the material at its surface, vanishes within.
  Vector<D> surface_gradient() const { return values.template segment<D>(1 + 2 * D).matrix(); }
  void set_surface_gradient(const Vector<D>& gradient) { values.template segment<D>(1 + 2 * D) = gradient.array(); }

  NodeSums& operator+=(const NodeSums& other)
  {
    values += other.values;
    return *this;
  }

  /// On a mirror normal to `axis` the image brings the opposite of every normal component.
  void hold_on_mirror(int axis)
  {
    for (const int vector : vectors) values[vector + axis] = 0;
  }

  /// These sums as a mirror normal to `axis` shows them.
  NodeSums mirrored(int axis) const
  {
    NodeSums image = *this;
    for (const int vector : vectors) image.values[vector + axis] = -image.values[vector + axis];
    return image;
  }

 private:
  static constexpr std::array<int, 3> vectors{1, 1 + D, 1 + 2 * D};
};

/// How a node moves through a step.
template <int D>
struct NodeMotion {
  static constexpr int n_values = D == 2 ? 4 : 8;
  using Values = Eigen::Array<double, n_values, 1>;

  Values values = Values::Zero();

  /// Velocity at the middle of the step [m/s].
  Vector<D> velocity() const { return values.template segment<D>(0).matrix(); }
  /// Its change from the middle of the step before [m/s]: what particles take from it.
  Vector<D> velocity_change() const { return values.template segment<D>(D).matrix(); }

  void set(const Vector<D>& velocity, const Vector<D>& change)
  {
    values.template segment<D>(0) = velocity.array();
    values.template segment<D>(D) = change.array();
  }

  void hold_on_mirror(int axis)
  {
    for (const int vector : vectors) values[vector + axis] = 0;
  }
  NodeMotion mirrored(int axis) const
  {
    NodeMotion image = *this;
    for (const int vector : vectors) image.values[vector + axis] = -image.values[vector + axis];
    return image;
  }

 private:
  static constexpr std::array<int, 2> vectors{0, D};
};

}  // namespace tamp::components
