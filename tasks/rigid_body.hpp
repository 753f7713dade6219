#pragma once

#include <array>
#include <optional>
#include <tuple>

#include "components/loads/rotating_frame.hpp"
#include "components/rigid/rigid_body.hpp"
#include "components/rigid/rigid_contact.hpp"
#include "runtime/data/views.hpp"
#include "runtime/grid/patch_layout.hpp"
#include "tasks/scene.hpp"

namespace tamp::tasks
{

/// The constant properties of a body of the scene that keeps its shape. Its motion is in `rigid_states`.
struct RigidBody {
  /// Places in Scene::bodies and Scene::materials.
  int body;
  int material;
  components::MassProperties properties{};
  /// Null where it moves freely under the forces on it.
  const BodyDrive* drive = nullptr;
  /// Mirrors against which it may lie: see touchable_mirrors.
  Sides touchable{};
  /// Components of its motion that stay at rest, because of mirrors on which it starts or the axis of an axisymmetric
  /// scene.
  components::Held still = components::nothing_held;

  components::Held held() const;
};

/// Positions and motions of the rigid bodies, by material; entries of deformable materials are unused.
struct RigidStates {
  std::array<components::RigidState, runtime::PerGroup<int>::max_groups> by_material;
  /// The impulse that drives each driven body in this step [N s].
  std::array<Eigen::Vector3d, runtime::PerGroup<int>::max_groups> driving;

  const components::RigidState& of(const RigidBody& body) const
  {
    return by_material[static_cast<std::size_t>(body.material)];
  }
  components::RigidState& of(const RigidBody& body) { return by_material[static_cast<std::size_t>(body.material)]; }
};

/// Impulses of contact on each material in one step.
struct ContactImpulses {
  struct Impulse {
    Eigen::Vector3d linear = Eigen::Vector3d::Zero();   ///< N s
    Eigen::Vector3d angular = Eigen::Vector3d::Zero();  ///< N m s; of rigid bodies alone, about their centre

    static constexpr auto fields = std::tuple{&Impulse::linear, &Impulse::angular};
  };
  std::array<Impulse, runtime::PerGroup<int>::max_groups> by_material;

  static constexpr auto fields = std::tuple{&ContactImpulses::by_material};
};

/// Contact of each rigid body, for its motion; unused for other materials.
struct RigidCouplings {
  std::array<components::RigidCoupling, runtime::PerGroup<int>::max_groups> by_material;

  static constexpr auto fields = std::tuple{&RigidCouplings::by_material};
};

/// A body at rest in itself that moves at `velocity` [m/s], and turns about its centre at `angular_velocity` [rad/s].
components::RigidState initial_state(const components::MassProperties& body, const Eigen::Vector3d& velocity,
                                     const Eigen::Vector3d& angular_velocity);

/// The state with the momenta that gravity [m/s^2] and the frame's turning give the body over a kick [s], which is
/// centred at `time`. Both act on the whole of the body, so that they turn it too where they differ across it.
components::RigidState accelerated(const components::MassProperties& body, const components::RigidState& before,
                                   const Eigen::Vector3d& gravity,
                                   const std::optional<components::RotatingFrame>& frame, double time, double kick);

/// The state of a driven body in a step from `time` on, with the momentum that takes it where it is to be at the end:
/// `free` is what it would have of body forces alone.
components::RigidState driven(const components::MassProperties& body, const BodyDrive& drive,
                              const components::RigidState& free, double time, double dt);

/// The mirrors that a body lies on at the start, to within half the spacing of its particles: planes of symmetry of the
/// whole of which it is a part.
Sides mirrors_beneath(const Scene& scene, const SceneBody& body);

/// The mirrors against which a rigid body may lie: those along which it is driven without turning; for one that is not
/// driven, or turns, those on which it starts.
Sides touchable_mirrors(const Scene& scene, const SceneBody& body);

/// The components of a motion that a body with planes of symmetry normal to these axes does not have: velocity along a
/// plane's normal, and spins about the other axes.
components::Held still_on_planes(const std::array<bool, 3>& normal_to);

/// The rigid body that the scene's body number `body` belongs to, but for its mass properties.
RigidBody make_rigid_body(const Scene& scene, int body);

/// Mass properties of the body from those of its particles; where it lies on a mirror, as a part of the whole, see
/// components::half_of_whole.
components::MassProperties within_whole(const RigidBody& body, const Scene& scene,
                                        const components::MassProperties& of_particles);

/// The state without the momenta that mirrors leave no room for, which forces on the part alone, or rounding, give.
components::RigidState at_rest_across_mirrors(const RigidBody& body, const components::RigidState& state);

/// Do the nodes that a particle at `x` reaches lie within the grid, whose edges nothing is known to hold, but for the
/// `touchable` ones? `reach` is how far it reaches in cells.
template <int D>
bool is_clear_of_edges(const runtime::Grid& grid, double reach, const Sides& touchable, const Vector<D>& x)
{
  const double distance = reach * grid.cell_size;
  for (int k = 0; k < D; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    if (!touchable[axis][0] && x[k] < grid.coordinate(k, 0) + distance) return false;
    if (!touchable[axis][1] && x[k] > grid.coordinate(k, grid.n_cells[axis]) - distance) return false;
  }
  return true;
}

/// The body at the end of a step of length `dt` in which contact gave it `impulse`, as far as it is not held, and body
/// forces the rest of the momenta of `free`. Throws SimulationError for one that spins too fast to be followed.
components::RigidState moved(const components::MassProperties& body, const components::RigidState& free,
                             const ContactImpulses::Impulse& impulse, const components::Held& held, double dt);

}  // namespace tamp::tasks
