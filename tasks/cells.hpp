#pragma once

#include <algorithm>
#include <cmath>

#include "components/tensors.hpp"
#include "runtime/graph/declaration.hpp"

namespace tamp::tasks
{

/// The cell of a patch that holds a particle of the patch at x [m].
template <int D>
runtime::Index cell_of(const runtime::Grid& grid, const runtime::IndexBox& cells, const Vector<D>& x)
{
  runtime::Index cell = cells.lower;
  for (std::size_t k = 0; k < D; ++k) {
    const double place = std::floor((x[static_cast<int>(k)] - grid.lower[k]) / grid.cell_size);
    cell[k] = std::clamp(static_cast<int>(place), cells.lower[k], cells.upper[k] - 1);
  }
  return cell;
}

template <int D>
runtime::Index cell_of(const runtime::TaskContext& at, const Vector<D>& x)
{
  return cell_of<D>(at.layout.grid(), at.patch.cells, x);
}

}  // namespace tamp::tasks
