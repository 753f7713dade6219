#include "tasks/method.hpp"

namespace tamp::tasks
{

template <class Interpolator>
Method<Interpolator>::Method(const Scene& scene)
    : interpolator(scene.particles_per_axis),
      cell_size(scene.grid.cell_size),
      gravity(vector_of<dimension>(scene.gravity)),
      viscosity(scene.artificial_viscosity),
      time_step_rule(scene.time.rule),
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
