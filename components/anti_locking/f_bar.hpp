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

/// The motion at the centre of a cell, by the linear functions N of its nodes.
template <int D>
struct MotionAtCentre {
  Vector<D> place;     ///< m
  Vector<D> velocity;  ///< sum v_i N_i [m/s]
  Matrix<D> gradient;  ///< sum v_i (x) grad N_i [1/s]; row: component of velocity
};

/// The motion at the centre of the cell that holds `x`. `nodes` and `inverse_mass`, 0 where there is none, are those of
/// the first node of the block. Empty where a corner of the cell has no mass, and so no velocity.
template <int D>
std::optional<MotionAtCentre<D>> motion_at_centre(const GridBlock<D>& block, const NodeMotion<D>* nodes,
                                                  const double* inverse_mass, const Vector<D>& x)
{
  constexpr int n_corners = 1 << D;
  const Vector<D> place = block.in_cells(x);
  Vector<D> centre;
  std::ptrdiff_t first = 0;
  for (std::size_t k = 0; k < D; ++k) {
    const int axis = static_cast<int>(k);
    const int cell = std::clamp(static_cast<int>(std::floor(place[axis])), 0, block.n_nodes[k] - 2);
    first += cell * block.strides[k];
    centre[axis] = block.origin[axis] + (cell + 0.5) * block.cell_size;
  }
  Vector<D> velocities = Vector<D>::Zero();
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
    velocities += nodes[node].velocity();
    sum += nodes[node].velocity() * side.transpose();
  }
  return MotionAtCentre<D>{centre, velocities / n_corners, sum * (2.0 / (n_corners * block.cell_size))};
}

/// Gives every particle of a cell the change of volume at the cell's centre, like E. A. de Souza Neto et al. (Int. J.
/// Solids Struct. 33, 1996) for finite elements and W. M. Coombs et al. (Comput. Methods Appl. Mech. Eng. 333, 2018)
/// for material points. `g`, dt times the gradients at the particles, is set to dt times those at the centre, where
/// there are any; and `hoop` of rings, which is empty for other particles, to dt v_r / r there.
template <int D>
void centre_gradients(const GridBlock<D>& block, const NodeMotion<D>* nodes, const double* inverse_mass,
                      std::span<const Vector<D>> position, double dt, std::span<Matrix<D>> g,
                      std::span<double> hoop = {})
{
  for (std::size_t p = 0; p < position.size(); ++p) {
    const auto at_centre = motion_at_centre<D>(block, nodes, inverse_mass, position[p]);
    if (!at_centre) continue;
    g[p] = dt * at_centre->gradient;
    if (!hoop.empty()) hoop[p] = dt * at_centre->velocity[0] / at_centre->place[0];
  }
}

}  // namespace tamp::components
