#include <stdexcept>
#include <vector>

#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases/phases.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

using components::NodeSums;
using components::Surroundings;
using runtime::GridView;
using runtime::Index;
using runtime::TaskContext;

namespace
{

template <int D>
void fold(const Wall<D>& wall, const TaskContext& at, const GridView<NodeSums<D>>& sums)
{
  if (!wall.keeps_normal_push()) return wall.image.fold(sums.data());
  wall.image.add_image(sums.data());
  for_each_wall_node(wall, at.layout.grid(), sums.box(), [&](const Index& i) {
    Vector<D> gradient = sums[i].surface_gradient();
    gradient[wall.axis] = 0;
    sums[i].set_surface_gradient(gradient);
  });
}

/// The gradients [1/s] that moments of velocity come to with the weights of this step.
template <int D>
std::vector<Matrix<D>> affine_gradients(const components::Interpolation<D>& interpolation,
                                        const components::GridBlock<D>& block,
                                        const components::ParticlePlaces<D>& places,
                                        std::span<const Matrix<D>> velocity_moments)
{
  std::vector<Matrix<D>> gradients(places.size());
  interpolation.second_moments(block, places, gradients);
  for (std::size_t p = 0; p < gradients.size(); ++p) {
    gradients[p] = components::affine_gradient<D>(velocity_moments[p], gradients[p]);
  }
  return gradients;
}

}  // namespace

template <int D>
runtime::TaskDeclaration particles_to_grid(const Method<D>& method)
{
  auto task = runtime::task("particles to grid")
                  .over_patches_and_groups()
                  .sparse()
                  .reads(particle::position<D>.previous(), particle::deformation_gradient<D>.previous(),
                         particle::velocity<D>.previous(), particle::mass.previous(), particle::volume.previous(),
                         particle::stress<D>.previous(), particle::viscous_pressure.previous())
                  .accumulates(node::sums<D>.halo(method.halo));
  const auto body = [&method](const TaskContext& at, auto data) {
    const auto sums = data[node::sums<D>];
    const auto block = block_of<D>(at.layout, sums);
    const components::Interpolation<D>& interpolation = method.interpolation(at.group);
    const components::ParticleSources<D> sources{.places = places_at_start<D>(data),
                                                 .velocity = data[particle::velocity<D>.previous()],
                                                 .mass = data[particle::mass.previous()],
                                                 .volume = data[particle::volume.previous()],
                                                 .stress = data[particle::stress<D>.previous()],
                                                 .viscous_pressure = data[particle::viscous_pressure.previous()]};
    interpolation.particles_to_grid(block, sources, method.needs_surface_of(at.group), sums.data());
    if constexpr (data.has(particle::velocity_gradient<D>)) {
      interpolation.add_gradient_momentum(block, sources.places, sources.mass,
                                          data[particle::velocity_gradient<D>.previous()], sums.data());
    }
    if constexpr (data.has(particle::velocity_moment<D>)) {
      interpolation.add_gradient_momentum(
          block, sources.places, sources.mass,
          affine_gradients<D>(interpolation, block, sources.places, data[particle::velocity_moment<D>.previous()]),
          sums.data());
    }
    // The image behind a wall gives to the grid as the particles do.
    for_each_wall(method, at, sums.box(), [&](const Wall<D>& wall) { fold(wall, at, sums); });
  };
  switch (method.surroundings) {
    case Surroundings::none:
      return std::move(task).body(body);
    case Surroundings::gradient:
      return std::move(task).reads(particle::velocity_gradient<D>.previous()).body(body);
    case Surroundings::moment:
      return std::move(task).reads(particle::velocity_moment<D>.previous()).body(body);
  }
  throw std::logic_error("unknown surroundings");
}

template runtime::TaskDeclaration particles_to_grid(const Method<2>&);
template runtime::TaskDeclaration particles_to_grid(const Method<3>&);

}  // namespace tamp::tasks
