#include "components/contact/parted_particles.hpp"

namespace tamp::components
{

template <int D>
void mark_near_cells(const GridBlock<D>& block, ContactPlane<D>* planes)
{
  const auto n = [&](std::size_t axis) { return axis < D ? block.n_nodes[axis] : 1; };
  const auto stride = [&](std::size_t axis) { return axis < D ? block.strides[axis] : 0; };
  const auto plane = [&](int x, int y, int z) -> ContactPlane<D>& {
    return planes[x * stride(0) + y * stride(1) + z * stride(2)];
  };
  // A particle reaches the nodes of its cell and one more layer.
  const auto first = [](int i) { return std::max(i - 2, 0); };
  const auto last = [&](int i, std::size_t axis) { return std::min(i + 1, n(axis) - 1); };
  for (int z = 0; z < n(2); ++z) {
    for (int y = 0; y < n(1); ++y) {
      for (int x = 0; x < n(0); ++x) {
        if (plane(x, y, z).side == 0) continue;
        for (int k = first(z); k <= last(z, 2); ++k) {
          for (int j = first(y); j <= last(y, 1); ++j) {
            for (int i = first(x); i <= last(x, 0); ++i) plane(i, j, k).is_near_cell = true;
          }
        }
      }
    }
  }
}

template <int D>
void add_regression(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
                    const ContactPlane<D>* planes, RegressionSums<D>* sums)
{
  interpolation.with_shape([&](const auto& shape) { add_regression(shape, block, places, planes, sums); });
}

template <int D>
void add_edges(const Interpolation<D>& interpolation, const GridBlock<D>& block, const ParticlePlaces<D>& places,
               const ContactPlane<D>* planes, EdgeSums<D>* sums)
{
  const double size = 1.0 / interpolation.n_per_axis();
  interpolation.with_shape([&](const auto& shape) { add_edges(shape, size, block, places, planes, sums); });
}

template void mark_near_cells(const GridBlock<2>&, ContactPlane<2>*);
template void mark_near_cells(const GridBlock<3>&, ContactPlane<3>*);
template void add_regression(const Interpolation<2>&, const GridBlock<2>&, const ParticlePlaces<2>&,
                             const ContactPlane<2>*, RegressionSums<2>*);
template void add_regression(const Interpolation<3>&, const GridBlock<3>&, const ParticlePlaces<3>&,
                             const ContactPlane<3>*, RegressionSums<3>*);
template void add_edges(const Interpolation<2>&, const GridBlock<2>&, const ParticlePlaces<2>&, const ContactPlane<2>*,
                        EdgeSums<2>*);
template void add_edges(const Interpolation<3>&, const GridBlock<3>&, const ParticlePlaces<3>&, const ContactPlane<3>*,
                        EdgeSums<3>*);

}  // namespace tamp::components
