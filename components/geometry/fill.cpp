#include "components/geometry/fill.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "components/errors.hpp"
#include "components/geometry/lattice_indices.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{

template <int D>
void ParticleLattice<D>::check() const
{
  if (!(cell_size > 0) || !std::isfinite(cell_size)) {
    throw BadValue("cell size " + std::to_string(cell_size), "a finite length above 0");
  }
  if (n_per_axis < 1) {
    throw BadValue(std::to_string(n_per_axis) + " particles along an axis of a cell", "1 or more");
  }
}

template <int D>
double ParticleLattice<D>::particle_volume() const
{
  return portable::pow(cell_size / n_per_axis, D);
}

template <int D>
Vector<D> ParticleLattice<D>::place(const std::array<int, std::size_t{D}>& cell,
                                    const std::array<int, std::size_t{D}>& site) const
{
  Vector<D> x;
  for (std::size_t k = 0; k < D; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    x[axis] = origin[axis] + cell_size * (cell[k] + (site[k] + 0.5) / n_per_axis);
  }
  return x;
}

template <int D>
CellRange<D> cells_near(const Box<D>& box, const ParticleLattice<D>& lattice, const CellRange<D>& cells)
{
  CellRange<D> range = cells;
  for (std::size_t k = 0; k < D; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const auto cell_of = [&](double x) { return std::floor((x - lattice.origin[axis]) / lattice.cell_size); };
    // Compared as doubles: a far box has cell numbers that an int does not hold.
    const double first = cells.lower[k], last = cells.upper[k];
    range.lower[k] = static_cast<int>(std::clamp(cell_of(box.lower[axis]) - 1, first, std::max(first, last)));
    range.upper[k] = static_cast<int>(std::clamp(cell_of(box.upper[axis]) + 2, first, std::max(first, last)));
  }
  return range;
}

template <int D>
std::vector<Vector<D>> fill(const Solid<D>& solid, const ParticleLattice<D>& lattice, const CellRange<D>& cells)
{
  lattice.check();
  using Indices = std::array<int, std::size_t{D}>;
  const CellRange<D> range = cells_near(solid.bounding_box(), lattice, cells);

  std::vector<Vector<D>> positions;
  for_each_index(range.lower, range.upper, [&](const Indices& cell) {
    for_each_index_below<D>(lattice.n_per_axis, [&](const Indices& site) {
      const Vector<D> x = lattice.place(cell, site);
      if (solid.contains(x)) positions.push_back(x);
    });
  });
  return positions;
}

template struct ParticleLattice<2>;
template struct ParticleLattice<3>;
template CellRange<2> cells_near(const Box<2>&, const ParticleLattice<2>&, const CellRange<2>&);
template CellRange<3> cells_near(const Box<3>&, const ParticleLattice<3>&, const CellRange<3>&);
template std::vector<Vector<2>> fill(const Solid<2>&, const ParticleLattice<2>&, const CellRange<2>&);
template std::vector<Vector<3>> fill(const Solid<3>&, const ParticleLattice<3>&, const CellRange<3>&);

}  // namespace tamp::components
