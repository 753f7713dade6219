#pragma once

#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/method.hpp"
#include "tasks/phases/places.hpp"
#include "tasks/phases/walls.hpp"

namespace tamp::tasks
{

/// Adds to the momenta of nodes what particles bring beside their velocities, where the transfer has them do so.
template <int D, class Data>
void bring_gradients(const components::Interpolation<D>& interpolation, const components::GridBlock<D>& block,
                     const Data& data, components::NodeSums<D>* sums)
{
  const components::ParticlePlaces<D> places = places_at_start<D>(data);
  const auto mass = data[particle::mass.previous()];
  const auto gradients = data[particle::velocity_gradient<D>];
  const auto moments = data[particle::velocity_moment<D>];
  if (!gradients.empty()) interpolation.add_gradient_momentum(block, places, mass, gradients, sums);
  if (!moments.empty()) interpolation.add_affine_momentum(block, places, mass, moments, sums);
}

/// Adds to the grid the image of what is scattered behind a wall.
template <int D>
void fold(const Wall<D>& wall, const runtime::TaskContext& at, const runtime::GridView<components::NodeSums<D>>& sums)
{
  if (!wall.keeps_normal_push()) return wall.image.fold(sums.data());
  wall.image.add_image(sums.data());
  for_each_wall_node(wall, at.layout.grid(), sums.box(), [&](const runtime::Index& i) {
    Vector<D> gradient = sums[i].surface_gradient();
    gradient[wall.axis] = 0;
    sums[i].set_surface_gradient(gradient);
  });
}

}  // namespace tamp::tasks
