#include "components/contact/wall_gaps.hpp"

#include <algorithm>

#include "components/contact/soft_gap.hpp"
#include "components/shapes/dense_stencil.hpp"
#include "components/shapes/stencil.hpp"

namespace tamp::components
{

template <int D>
void add_wall_gaps(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                   double size, std::span<const PlaneWall> walls, WallGaps<D>* sums)
{
  const double range = 2 * block.cell_size;
  interpolation.with_shape([&](const auto& shape) {
    for (std::size_t p = 0; p < places.size(); ++p) {
      const Vector<D>& x = places.position[p];
      WallGaps<D> share;
      bool is_near = false;
      for (const PlaneWall& wall : walls) {
        const double distance = wall.distance<D>(x);
        if (!(std::abs(distance) <= range)) continue;
        const double stretch =
            places.deformation_gradient.empty() ? 1.0 : places.deformation_gradient[p].row(wall.axis).norm();
        const auto [weight, gap] = soft_gap(distance, size * stretch, size);
        share.values.template segment<2>(share.at(wall)) << weight, weight * gap;
        is_near = true;
      }
      if (!is_near) continue;
      for_each_stencil(shape, block, places.subspan(p, 1), [&](std::size_t, const auto& stencil) {
        for_each_weight(block, stencil,
                        [&](std::ptrdiff_t node, double weight) { sums[node].values += weight * share.values; });
      });
    }
  });
}

template void add_wall_gaps(const Interpolation<2>&, const GridBlock<2>&, const ParticlePlaces<2>&, double,
                            std::span<const PlaneWall>, WallGaps<2>*);
template void add_wall_gaps(const Interpolation<3>&, const GridBlock<3>&, const ParticlePlaces<3>&, double,
                            std::span<const PlaneWall>, WallGaps<3>*);

}  // namespace tamp::components
