#pragma once

#include <algorithm>
#include <cmath>

#include "components/tensors.hpp"
#include "runtime/graph/declaration.hpp"

namespace tamp::tasks
{

/// The cell of the patch that holds a particle of it.
template <int D>
runtime::Index cell_of(const runtime::TaskContext& at, const Vector<D>& x)
{
  const runtime::Grid& grid = at.layout.grid();
  runtime::Index cell = at.patch.cells.lower;
  for (std::size_t k = 0; k < D; ++k) {
    const double place = std::floor((x[static_cast<int>(k)] - grid.lower[k]) / grid.cell_size);
    cell[k] = std::clamp(static_cast<int>(place), at.patch.cells.lower[k], at.patch.cells.upper[k] - 1);
  }
  return cell;
}

}  // namespace tamp::tasks
