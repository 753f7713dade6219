#pragma once

#include <Eigen/Core>
#include <array>
#include <tuple>

#include "components/rigid/rigid_body.hpp"

/// Contact of a rigid body with matter on a grid: all nodes together, because they share the body's six degrees of
/// freedom. At each node the impulse on the matter is J = C (u - v), v being its velocity before contact and u the
/// body's velocity there when the step is done: C is m I where they stick, m (n + mu t) n^T where they slide along the
/// unit tangent t with friction mu, n the unit normal from the body to the matter and m the mass of the matter at the
/// node. (With the mass of the two together there, as between deformable bodies, the body would sink into what it rests
/// on: it cannot give way at one node, so every step would leave some of the approach.)
namespace tamp::components
{

/// The contact of one node, C above [kg], and the velocity v of the matter [m/s].
struct NodeContact {
  Matrix3 coupling;
  Vector3 velocity;
};

/// `free` is the velocity that the body would have at the node without contact. It tells whether they approach, and
/// whether friction can hold them together; C is zero if they part. That is not asked again when the body's motion is
/// known: a node from which contact turns the body away still counts for it, and one that it is turned towards does
/// not.
NodeContact node_contact(double mass, const Vector3& normal, double friction, const Vector3& free,
                         const Vector3& velocity);

/// Which components of a body's motion contact cannot change, as they are driven or a plane of symmetry lies across
/// them: the velocity of the centre along each axis, then the spin about each.
using Held = std::array<bool, 6>;
inline constexpr Held nothing_held{}, translation_held{true, true, true}, all_held{true, true, true, true, true, true};

/// Sums of all nodes' contact, from which the motion of the body after it follows.
struct RigidCoupling {
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  using Vector6 = Eigen::Matrix<double, 6, 1>;

  /// With B = (I, -[arm]x), the velocity at a node from that of the centre and the spin: sum B^T C B and sum B^T C v.
  Matrix6 matrix = Matrix6::Zero();
  Vector6 right_side = Vector6::Zero();

  static constexpr auto fields = std::tuple{&RigidCoupling::matrix, &RigidCoupling::right_side};

  /// `arm` is the place of the node seen from the body's centre [m].
  void add(const NodeContact& contact, const Vector3& arm);

  /// The motion of a body which has `free` momenta before contact: the one whose change of momentum is minus the sum of
  /// all J. Implicit in the body's own velocity, so that it holds however light the body is beside what it touches.
  /// Components that are held keep their part of the free motion.
  RigidMotion solve(const MassProperties& body, const RigidState& free, const Held& held = nothing_held) const;
};

}  // namespace tamp::components
