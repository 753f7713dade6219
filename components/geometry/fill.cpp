#include "components/geometry/fill.hpp"

#include <algorithm>
#include <cmath>
#include <string>

#include "components/errors.hpp"
#include "components/portable_math.hpp"

namespace tamp::components
{
namespace
{

template <int D>
void check(const ParticleLattice<D>& lattice)
{
  if (!(lattice.cell_size > 0) || !std::isfinite(lattice.cell_size)) {
    throw BadValue("cell size " + std::to_string(lattice.cell_size), "a finite length above 0");
  }
  if (lattice.n_per_axis < 1) {
    throw BadValue(std::to_string(lattice.n_per_axis) + " particles along an axis of a cell", "1 or more");
  }
}

/// The cells of `cells` that the box touches, with one cell to spare on each side against round-off.
template <int D>
CellRange<D> near(const Box<D>& box, const ParticleLattice<D>& lattice, const CellRange<D>& cells)
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

/// Calls `visit` for every index lower <= i < upper, x fastest.
template <int D, class Visit>
void for_each_index(const std::array<int, std::size_t{D}>& lower, const std::array<int, std::size_t{D}>& upper,
                    Visit&& visit)
{
  for (std::size_t k = 0; k < D; ++k) {
    if (lower[k] >= upper[k]) return;
  }
  std::array<int, std::size_t{D}> i = lower;
  while (true) {
    visit(i);
    std::size_t k = 0;
    while (k < D && ++i[k] == upper[k]) {
      i[k] = lower[k];
      ++k;
    }
    if (k == D) return;
  }
}

}  // namespace

template <int D>
double ParticleLattice<D>::particle_volume() const
{
  return portable::pow(cell_size / n_per_axis, D);
}

template <int D>
std::vector<Vector<D>> fill(const Solid<D>& solid, const ParticleLattice<D>& lattice, const CellRange<D>& cells)
{
  check(lattice);
  using Indices = std::array<int, std::size_t{D}>;
  Indices first_site, last_site;
  first_site.fill(0);
  last_site.fill(lattice.n_per_axis);
  const CellRange<D> range = near(solid.bounding_box(), lattice, cells);

  std::vector<Vector<D>> positions;
  for_each_index<D>(range.lower, range.upper, [&](const Indices& cell) {
    for_each_index<D>(first_site, last_site, [&](const Indices& site) {
      Vector<D> x;
      for (std::size_t k = 0; k < D; ++k) {
        const auto axis = static_cast<Eigen::Index>(k);
        x[axis] = lattice.origin[axis] + lattice.cell_size * (cell[k] + (site[k] + 0.5) / lattice.n_per_axis);
      }
      if (solid.contains(x)) positions.push_back(x);
    });
  });
  return positions;
}

template struct ParticleLattice<2>;
template struct ParticleLattice<3>;
template std::vector<Vector<2>> fill(const Solid<2>&, const ParticleLattice<2>&, const CellRange<2>&);
template std::vector<Vector<3>> fill(const Solid<3>&, const ParticleLattice<3>&, const CellRange<3>&);

}  // namespace tamp::components
