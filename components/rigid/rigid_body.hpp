#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <span>

#include "components/tensors.hpp"

/// A body that keeps its shape: six degrees of freedom. SI units, axes of space unless the name says otherwise. Plane
/// strain is the same with every place and momentum in the x-y plane.
namespace tamp::components
{

using Vector3 = Vector<3>;
using Matrix3 = Matrix<3>;

/// How the mass of a body is spread, in the orientation of its start.
struct MassProperties {
  double mass = 0;                            ///< kg
  Vector3 centre = Vector3::Zero();           ///< centre of mass at the start [m]
  Matrix3 inertia = Matrix3::Zero();          ///< about the centre, sum m (r.r I - r r^T) [kg m^2]
  Matrix3 inverse_inertia = Matrix3::Zero();  ///< [1/(kg m^2)]

  /// sum m r r^T about the centre [kg m^2].
  Matrix3 second_moment() const { return 0.5 * inertia.trace() * Matrix3::Identity() - inertia; }
};

/// Mass, centre and inertia of particles of these masses [kg] at these places [m], each spread over a cube of edge
/// `particle_size` [m]; in the `plane` the body turns about z only. Throws BadValue for fewer than two particles.
MassProperties mass_properties(std::span<const double> mass, std::span<const Vector3> position, double particle_size,
                               bool plane);

/// Mass properties of the half of a body that is cut by a plane of symmetry, normal to `axis` at `place` [m], from
/// those of that half by itself: half of those of the whole, whose centre lies on the plane and which turns about the
/// plane's normal without wobbling.
MassProperties half_of_whole(const MassProperties& half, int axis, double place);

/// Position and motion of a rigid body.
struct RigidState {
  Vector3 centre = Vector3::Zero();
  /// Rotation from the orientation at the start; of unit length.
  Eigen::Quaterniond orientation = Eigen::Quaterniond::Identity();
  Vector3 momentum = Vector3::Zero();          ///< N s
  Vector3 angular_momentum = Vector3::Zero();  ///< about the centre [N m s]
};

/// Inertia about the centre as the body is turned now [kg m^2], and its inverse.
Matrix3 inertia_now(const MassProperties& body, const RigidState& state);
Matrix3 inverse_inertia_now(const MassProperties& body, const RigidState& state);

Vector3 angular_velocity(const MassProperties& body, const RigidState& state);

/// Kinetic energy of translation and rotation [J].
double kinetic_energy(const MassProperties& body, const RigidState& state);

/// Velocity of the body's matter at every place, v(x) = v_c + w x (x - c).
struct RigidMotion {
  Vector3 centre = Vector3::Zero();
  Vector3 velocity = Vector3::Zero();
  Vector3 spin = Vector3::Zero();  ///< angular velocity w [rad/s]

  Vector3 at(const Vector3& x) const { return velocity + spin.cross(x - centre); }
};

RigidMotion motion_of(const MassProperties& body, const RigidState& state);

/// Moves and turns the body for `dt` under its momenta, which stay what they are.
///
/// The rotation is the implicit midpoint rule in the frame of the body. With Pi the angular momentum seen there and W
/// the mean of I^-1 Pi before and after, the orientation turns by the Cayley map of W dt. That map carries Pi along as
/// Euler's equations at midpoint do, so the spatial angular momentum is kept as it is stored, and the energy Pi.I^-1 Pi
/// / 2, a quadratic invariant, to round-off (M. Austin, P. S. Krishnaprasad & L.-S. Wang, J. Comput. Phys. 107, 1993).
/// Second order in the orientation. The midpoint is found by iteration to round-off; a step that turns the body too far
/// for that is made in equal parts. Throws BadValue where even a thousand parts are too few, or a momentum is no
/// number.
RigidState drift(const MassProperties& body, const RigidState& state, double dt);

}  // namespace tamp::components
