#include "components/contact/wall_loads.hpp"

#include <cmath>

#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/stencil.hpp"

namespace tamp::components
{

namespace
{

constexpr double early_from = 0.25;  ///< cells

template <int D>
bool lies_on(const PlaneWall& wall, const GridBlock<D>& block, std::ptrdiff_t node)
{
  const double place = block.origin[wall.axis] + block.cells_to(node)[wall.axis] * block.cell_size;
  return std::abs(place - wall.place) < 0.5 * block.cell_size;
}

}  // namespace

template <int D>
WallLoads wall_loads(const Interpolation<D>& interpolation, const GridBlock<D>& block,
                     const LoadedParticles<D>& particles, std::span<const PlaneWall> walls, const WallGaps<D>* gaps)
{
  const double range = 2 * block.cell_size;
  WallLoads loads;
  const auto is_first = [&](std::size_t p) {
    return loads.first_early < 0 || particles.id[p] < particles.id[static_cast<std::size_t>(loads.first_early)];
  };
  interpolation.with_shape([&](const auto& shape) {
    for (std::size_t p = 0; p < particles.places.size(); ++p) {
      for (const PlaneWall& wall : walls) {
        const double pressed = -particles.volume[p] * particles.stress[p][wall.axis];
        if (!(pressed > 0) || !(wall.distance<D>(particles.places.position[p]) <= range)) continue;
        const auto add = [&](std::ptrdiff_t node, double weight) {
          if (!lies_on(wall, block, node) || !(weight > 0) || !(gaps[node].weight(wall) > 0)) return;
          loads.whole += weight * pressed;
          if (!(gaps[node].gap(wall) > early_from * block.cell_size)) return;
          loads.early += weight * pressed;
          if (is_first(p)) loads.first_early = static_cast<std::ptrdiff_t>(p);
        };
        for_each_stencil(shape, block, particles.places.subspan(p, 1),
                         [&](std::size_t, const auto& stencil) { for_each_weight(block, stencil, add); });
      }
    }
  });
  return loads;
}

template WallLoads wall_loads(const Interpolation<2>&, const GridBlock<2>&, const LoadedParticles<2>&,
                              std::span<const PlaneWall>, const WallGaps<2>*);
template WallLoads wall_loads(const Interpolation<3>&, const GridBlock<3>&, const LoadedParticles<3>&,
                              std::span<const PlaneWall>, const WallGaps<3>*);

}  // namespace tamp::components
