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

template void mark_near_cells(const GridBlock<2>&, ContactPlane<2>*);
template void mark_near_cells(const GridBlock<3>&, ContactPlane<3>*);

}  // namespace tamp::components
