#include "components/loads/pressed_particles.hpp"

#include "components/shapes/stencil.hpp"

namespace tamp::components
{

template <int D>
void add_pressure(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                  std::span<const ByFace<D>> pressure, PressureSums<D>* sums)
{
  interpolation.with_shape([&](const auto& shape) {
    for_each_stencil(shape, block, places, [&](std::size_t p, const auto& stencil) {
      for_each_weight(block, stencil,
                      [&](std::ptrdiff_t node, double weight) { sums[node].add(weight * pressure[p]); });
    });
  });
}

template void add_pressure(const Interpolation<2>&, const GridBlock<2>&, const ParticlePlaces<2>&,
                           std::span<const ByFace<2>>, PressureSums<2>*);
template void add_pressure(const Interpolation<3>&, const GridBlock<3>&, const ParticlePlaces<3>&,
                           std::span<const ByFace<3>>, PressureSums<3>*);

}  // namespace tamp::components
