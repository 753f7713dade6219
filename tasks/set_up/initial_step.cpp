#include "tasks/set_up/initial_step.hpp"

#include <algorithm>
#include <limits>
#include <vector>

#include "components/loads/time_step.hpp"
#include "components/materials/wave_speed.hpp"
#include "tasks/set_up/deformed_start.hpp"
#include "tasks/set_up/initial_moduli.hpp"
#include "tasks/set_up/settled_ground.hpp"

namespace tamp::tasks
{

namespace
{

template <int D>
components::TangentModuli greatest_initial_moduli(const Scene& scene, const SceneBody& body)
{
  const SceneMaterial& material = scene.materials[static_cast<std::size_t>(body.material)];
  components::TangentModuli moduli = initial_moduli(material);
  if (body.functions.deformation_gradient) moduli = greatest_deformed_moduli<D>(scene, body);
  if (body.initial_stress) {
    const double ratio = moduli.shear_modulus / moduli.bulk_modulus;
    moduli.bulk_modulus = SettledGround<D>(scene, body).greatest_bulk_modulus();
    moduli.shear_modulus = ratio * moduli.bulk_modulus;
  }
  return moduli;
}

/// The bound for a body by itself whose matter is no faster than `v` along any axis. Its nodes are not known yet, so
/// that each particle may have its own to itself.
template <int D>
double stable_step_of(const Method<D>& method, const SceneBody& body, const Vector<D>& v)
{
  const double h = method.cell_size;
  if (body.rigid) return components::published_time_step<D>(h, 0, v);
  const auto [bulk, shear] = greatest_initial_moduli<D>(method.scene, body);
  const double density = method.materials[static_cast<std::size_t>(body.material)].density;
  if (method.time_step_rule == StepRule::published) {
    return components::published_time_step<D>(h, components::wave_speed(bulk, shear, density), v);
  }
  const double own_stiffness = method.interpolation(body.material).greatest_own_stiffness();
  return components::viscous_time_step<D>(h, {density, bulk, shear, v, 0, own_stiffness},
                                          method.viscosity.value_or(components::ArtificialViscosity{0, 0}),
                                          method.amplification);
}

}  // namespace

template <int D>
double initial_stable_step(const Method<D>& method, const BodyParticles<D>& particles)
{
  double bound = std::numeric_limits<double>::infinity();
  std::vector<Eigen::AlignedBox<double, D>> velocities;
  for (const SceneBody& body : method.scene.bodies) {
    const auto own = particles.velocities(static_cast<int>(velocities.size()));
    const Vector<D> v = own.min().cwiseAbs().cwiseMax(own.max().cwiseAbs());
    bound = std::min(bound, stable_step_of(method, body, v));
    velocities.push_back(own);
    if (method.time_step_rule == StepRule::published) continue;
    for (std::size_t other = 0; other + 1 < velocities.size(); ++other) {
      const auto& theirs = velocities[other];
      const double approach = (own.max() - theirs.min()).cwiseMax(theirs.max() - own.min()).norm();
      bound = std::min(bound, components::contact_time_step(method.cell_size, approach));
    }
  }
  return bound;
}

template double initial_stable_step(const Method<2>&, const BodyParticles<2>&);
template double initial_stable_step(const Method<3>&, const BodyParticles<3>&);

}  // namespace tamp::tasks
