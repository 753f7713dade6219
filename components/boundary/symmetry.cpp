#include "components/boundary/symmetry.hpp"

#include <string>

#include "components/errors.hpp"

namespace tamp::components
{

template <int D>
SymmetryWall<D>::SymmetryWall(const std::array<int, std::size_t{D}>& n_nodes, int axis, int plane, int outside)
    : axis_(axis)
{
  if (axis < 0 || axis >= D) {
    throw BadValue("axis " + std::to_string(axis), "an axis from 0 to " + std::to_string(D - 1));
  }
  if (outside != -1 && outside != 1) throw BadValue("outside " + std::to_string(outside), "-1 or +1");
  const int n_along = n_nodes[static_cast<std::size_t>(axis)];
  if (plane < 1 || plane > n_along - 2) {
    throw BadValue("wall at node " + std::to_string(plane) + " of " + std::to_string(n_along),
                   "a wall with a node layer on each side");
  }

  std::ptrdiff_t step = 1;
  std::size_t across = 0;
  for (int k = 0; k < D; ++k) {
    const int n = n_nodes[static_cast<std::size_t>(k)];
    if (k == axis) {
      first_ = plane * step;
      to_ghost_ = outside * step;
    } else {
      n_across_[across] = n;
      step_across_[across++] = step;
    }
    step *= n;
  }
}

template class SymmetryWall<2>;
template class SymmetryWall<3>;

}  // namespace tamp::components
