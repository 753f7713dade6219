#include "components/shapes/transfer.hpp"
#include "tasks/labels.hpp"
#include "tasks/phases.hpp"
#include "tasks/walls.hpp"

namespace tamp::tasks
{

using components::NodeSums;
using components::SymmetryWall;
using runtime::GridView;
using runtime::TaskContext;

/// `velocity_gradient` is there where the transfer is affine.
template <class Interpolator>
runtime::TaskDeclaration particles_to_grid(const Method<Interpolator>& method)
{
  constexpr int D = Interpolator::dimension;
  auto task =
      runtime::task("particles to grid")
          .over_patches_and_groups()
          .sparse()
          .reads(particle::position<D>.previous(), particle::velocity<D>.previous(), particle::mass.previous(),
                 particle::volume.previous(), particle::stress<D>.previous(), particle::viscous_pressure.previous())
          .accumulates(node::sums<D>.halo(1));
  const auto body = [&method](const TaskContext& at, std::span<const Vector<D>> position,
                              std::span<const Vector<D>> velocity, std::span<const double> mass,
                              std::span<const double> volume, std::span<const SymmetricTensor<D>> stress,
                              std::span<const double> viscous_pressure, GridView<NodeSums<D>> sums,
                              auto... velocity_gradient) {
    const auto block = block_of<D>(at.layout, sums);
    const Interpolator& interpolator = method.interpolator(at.group);
    components::particles_to_grid(interpolator, block, {position, velocity, mass, volume, stress, viscous_pressure},
                                  sums.data());
    (components::add_gradient_momentum(interpolator, block, position, mass, velocity_gradient, sums.data()), ...);
    // The image behind a mirror gives to the grid as the particles do.
    for_each_wall(method, at, sums.box(), [&](const SymmetryWall<D>& wall) { wall.fold(sums.data()); });
  };
  if (method.transfer == Transfer::flip) return std::move(task).body(body);
  return std::move(task).reads(particle::velocity_gradient<D>.previous()).body(body);
}

template runtime::TaskDeclaration particles_to_grid(const Method<components::Gimp<2>>&);
template runtime::TaskDeclaration particles_to_grid(const Method<components::Gimp<3>>&);

}  // namespace tamp::tasks
