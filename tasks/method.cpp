#include "tasks/method.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "components/loads/time_step.hpp"

namespace tamp::tasks
{

namespace
{

/// An edge is on a node to within 1e-12 cells; the weight there is the square of that.
constexpr double least_weight = 1e-24;

double least_particle_mass(const Scene& scene)
{
  double density = std::numeric_limits<double>::infinity();
  for (const SceneMaterial& m : scene.materials) density = std::min(density, m.density);
  return density * std::pow(scene.grid.cell_size / scene.particles_per_axis, scene.grid.dimension);
}

}  // namespace

template <class Interpolator>
Method<Interpolator>::Method(const Scene& scene)
    : interpolator(scene.particles_per_axis),
      cell_size(scene.grid.cell_size),
      least_node_mass(least_weight * least_particle_mass(scene)),
      gravity(vector_of<dimension>(scene.gravity)),
      viscosity(scene.artificial_viscosity),
      time_step_rule(scene.time.rule),
      step_factor(components::transfer_step_factor(scene.particles_per_axis)),
      friction(static_cast<int>(scene.materials.size())),
      materials(scene.materials)
{
  for (std::size_t k = 0; k < std::size_t{dimension}; ++k) {
    for (std::size_t side = 0; side < 2; ++side) mirrors[k][side] = scene.faces[k][side] == Face::symmetry;
  }
  for (const SceneContact& pair : scene.contacts) friction.set(pair.material_a, pair.material_b, pair.friction);
}

template struct Method<components::Gimp<2>>;
template struct Method<components::Gimp<3>>;

}  // namespace tamp::tasks
