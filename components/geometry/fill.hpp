#pragma once

#include <array>
#include <vector>

#include "components/geometry/solid.hpp"
#include "components/tensors.hpp"

namespace tamp::components
{

/// Cubic cells with regularly placed sites for particles: `n_per_axis` along each axis of every cell, each the centre
/// of an equal share of the cell. Lengths in m.
template <int D>
struct ParticleLattice {
  /// The corner at which cell (0, 0, 0) starts.
  Vector<D> origin;
  double cell_size;
  int n_per_axis;

  /// The share of one particle [m^3]; in the plane of one metre of thickness.
  double particle_volume() const;
  /// Place of a site within a cell [m], both given by their indices along every axis.
  Vector<D> place(const std::array<int, std::size_t{D}>& cell, const std::array<int, std::size_t{D}>& site) const;
  /// Throws BadValue for a cell size or a number of sites that is not above 0.
  void check() const;
};

/// Cells lower <= i < upper along every axis.
template <int D>
struct CellRange {
  std::array<int, std::size_t{D}> lower;
  std::array<int, std::size_t{D}> upper;
};

/// The cells of `cells` that the box touches, with one cell to spare on each side against round-off.
template <int D>
CellRange<D> cells_near(const Box<D>& box, const ParticleLattice<D>& lattice, const CellRange<D>& cells);

/// Positions of the particles that fill the part of `solid` within `cells`: the sites that the solid contains, cell by
/// cell with x fastest, and within a cell x fastest too. A site depends on its cell alone, so the same particles come
/// out, bit for bit, however the cells of a grid are shared out among calls.
/// Throws what the lattice's check throws.
template <int D>
std::vector<Vector<D>> fill(const Solid<D>& solid, const ParticleLattice<D>& lattice, const CellRange<D>& cells);

}  // namespace tamp::components
