#pragma once

#include <Eigen/Geometry>
#include <cstdint>
#include <map>
#include <vector>

#include "components/rigid/rigid_body.hpp"
#include "components/tensors.hpp"
#include "runtime/warehouse/warehouse.hpp"
#include "tasks/scene.hpp"
#include "tasks/set_up/body_sites.hpp"
#include "tasks/set_up/settled_ground.hpp"

namespace tamp::tasks
{

/// The particles of a scene's bodies as they are at its start: at rest in themselves, without stress or settled, and
/// moving with their body, unless the body's functions say otherwise. Ids count bodies and cells, and so do not depend
/// on the cut into patches.
template <int D>
class BodyParticles
{
 public:
  /// The scene must outlive this object.
  BodyParticles(const Scene& scene, const runtime::PatchLayout& layout);

  /// How many there are, by patch, then material.
  std::vector<std::size_t> counts() const;
  /// Spans the velocities of a body's particles [m/s].
  Eigen::AlignedBox<double, D> velocities(int body) const;
  /// Energy stored in all particles that start deformed [J].
  double stored_energy() const;
  /// Mass, centre and inertia of a rigid body. Throws BadValue for one that has fewer than two particles.
  components::MassProperties mass_properties(int body) const;
  /// Puts them into the patches that are the warehouse's own.
  void store(runtime::Warehouse& warehouse) const;

 private:
  /// The particles of one material on one patch.
  struct Particles {
    std::vector<std::int64_t> id;
    std::vector<std::int64_t> body;
    /// Their undeformed sites, and their positions [m].
    std::vector<components::Site<D>> site;
    std::vector<Vector<D>> position;
  };

  /// The velocity at x [m/s] from the scene's velocity and angular velocity alone.
  Vector<D> rigid_velocity(int body, const Vector<D>& x) const;
  Vector<D> initial_velocity(const Particles& particles, std::size_t p) const;
  void store(const Particles& particles, int patch, int material, runtime::Warehouse& warehouse) const;
  /// Stores the velocity moments of the body's rotation, with the weights at the start.
  void store_velocity_moments(const Particles& particles, int patch, int material, runtime::Warehouse& warehouse) const;

  const Scene& scene_;
  /// By [patch][material], bodies in their order.
  std::vector<std::vector<Particles>> particles_;
  /// Mean place of each body's particles.
  std::vector<Vector<D>> centres_;
  /// The bodies that start settled, by their index in the scene's list.
  std::map<std::size_t, SettledGround<D>> settled_;
};

}  // namespace tamp::tasks
