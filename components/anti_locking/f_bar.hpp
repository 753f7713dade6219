#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>

#include "components/shapes/grid_block.hpp"
#include "components/shapes/node_sums.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// sum v_i (x) grad N_i [1/s] at the centre of the cell that holds `x`, N the linear functions of its nodes; row:
/// component of velocity. `nodes` and `inverse_mass`, 0 where there is none, are those of the first node of the block.
/// Empty where a corner of the cell has no mass, and so no velocity.
template <int D>
std::optional<Matrix<D>> gradient_at_centre(const GridBlock<D>& block, const NodeMotion<D>* nodes,
                                            const double* inverse_mass, const Vector<D>& x)
{
  constexpr int n_corners = 1 << D;
  const Vector<D> place = block.in_cells(x);
  std::ptrdiff_t first = 0;
  for (std::size_t k = 0; k < D; ++k) {
    const auto cell = static_cast<int>(std::floor(place[static_cast<int>(k)]));
    first += std::clamp(cell, 0, block.n_nodes[k] - 2) * block.strides[k];
  }
  Matrix<D> sum = Matrix<D>::Zero();
  for (int corner = 0; corner < n_corners; ++corner) {
    Vector<D> side;
    std::ptrdiff_t node = first;
    for (int k = 0; k < D; ++k) {
      const bool is_upper = ((corner >> k) & 1) != 0;
      side[k] = is_upper ? 1 : -1;
      if (is_upper) node += block.strides[static_cast<std::size_t>(k)];
    }
    if (inverse_mass[node] == 0) return std::nullopt;
    sum += nodes[node].velocity() * side.transpose();
  }
  return Matrix<D>(sum * (2.0 / (n_corners * block.cell_size)));
}

/// As E. A. de Souza Neto et al. (Int. J. Solids Struct. 33, 1996) for finite elements and W. M. Coombs et al. (Comput.
/// Methods Appl. Mech. Eng. 333, 2018) for material points: every particle of a cell takes the change of volume at its
/// centre. `g`, dt times the gradients at the particles, is set to dt times those there, where there are any.
template <int D>
void centre_gradients(const GridBlock<D>& block, const NodeMotion<D>* nodes, const double* inverse_mass,
                      std::span<const Vector<D>> position, double dt, std::span<Matrix<D>> g)
{
  for (std::size_t p = 0; p < position.size(); ++p) {
    if (const auto at_centre = gradient_at_centre<D>(block, nodes, inverse_mass, position[p])) g[p] = dt * *at_centre;
  }
}

}  // namespace tamp::components
