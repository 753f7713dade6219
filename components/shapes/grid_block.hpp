#pragma once

#include <array>
#include <cstddef>

#include "components/lanes.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// The nodes of a part of a uniform grid, as kernels see them: where they are and how they lie in memory.
template <int D>
struct GridBlock {
  /// Position of the first node [m].
  Vector<D> origin;
  double cell_size;
  std::array<int, D> n_nodes;
  /// Distance from a node to the next along each axis, in values.
  std::array<std::ptrdiff_t, D> strides;

  /// Position in cells from the first node.
  Vector<D> in_cells(const Vector<D>& x) const { return (x - origin) * (1 / cell_size); }
  /// Cells from the first node to the one that lies `node` values after it.
  Vector<D> cells_to(std::ptrdiff_t node) const
  {
    Vector<D> cells;
    for (int k = D - 1; k >= 0; --k) {
      const std::ptrdiff_t stride = strides[static_cast<std::size_t>(k)];
      const std::ptrdiff_t whole = node / stride;
      cells[k] = static_cast<double>(whole);
      node -= whole * stride;
    }
    return cells;
  }
};

/// The cell of a particle at `place`, in cells from the first node of a block of `n_nodes` along an axis, the first and
/// the last of which lie beyond the patch. What rounding takes for beyond it lies on its face, and in its last cell.
template <class Number>
Number owned_cell(const Number& place, int n_nodes)
{
  return greater_of<Number>(lesser_of<Number>(floor(place), n_nodes - 3.0), 1.0);
}

}  // namespace tamp::components
