#include "components/geometry/cut_lattice.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <unordered_map>

#include "components/geometry/lattice_indices.hpp"

namespace tamp::components
{
namespace
{

template <int D>
using Indices = std::array<int, std::size_t{D}>;

/// Indices lower <= i < upper, numbered with x fastest.
template <int D>
struct Block {
  Indices<D> lower, upper;

  bool contains(const Indices<D>& i) const
  {
    for (std::size_t k = 0; k < D; ++k) {
      if (i[k] < lower[k] || i[k] >= upper[k]) return false;
    }
    return true;
  }
  std::size_t number(const Indices<D>& i) const
  {
    std::size_t number = 0;
    for (std::size_t k = D; k-- > 0;) {
      number = number * static_cast<std::size_t>(upper[k] - lower[k]) + static_cast<std::size_t>(i[k] - lower[k]);
    }
    return number;
  }
  std::size_t size() const
  {
    std::size_t size = 1;
    for (std::size_t k = 0; k < D; ++k) size *= static_cast<std::size_t>(upper[k] - lower[k]);
    return size;
  }
};

/// The part of a site's share that a solid holds: the number of sample points in it, and the sum of their places.
template <int D>
struct Held {
  double n = 0;
  Vector<D> sum = Vector<D>::Zero();

  void add(const Held& other, double part)
  {
    n += part * other.n;
    sum += part * other.sum;
  }
};

/// Which sites of a lattice a solid fills, and what it holds of the others.
template <int D>
class CutLattice
{
 public:
  CutLattice(const Solid<D>& solid, const ParticleLattice<D>& lattice, const CellRange<D>& cells)
      : solid_(solid), lattice_(lattice), sites_{cells.lower, cells.upper}
  {
    for (std::size_t k = 0; k < D; ++k) {
      sites_.lower[k] *= lattice.n_per_axis;
      sites_.upper[k] *= lattice.n_per_axis;
    }
    whole_.resize(sites_.size());
    find_held();
    give_away_slivers();
  }

  /// The particle of the site, with its volume in shares; none where the volume is 0.
  Site<D> particle(const Indices<D>& cell, const Indices<D>& site) const
  {
    Indices<D> i;
    for (std::size_t k = 0; k < D; ++k) i[k] = cell[k] * lattice_.n_per_axis + site[k];
    if (whole_[sites_.number(i)]) return {lattice_.place(cell, site), 1};
    const auto cut = cut_.find(sites_.number(i));
    if (cut == cut_.end()) return {Vector<D>::Zero(), 0};
    return {cut->second.sum / cut->second.n, cut->second.n / n_points};
  }

 private:
  static constexpr int points_per_axis = D == 2 ? 32 : 10;
  static constexpr double n_points = D == 2 ? 32 * 32 : 10 * 10 * 10;
  static constexpr int all_held = (1 << D) + 1;

  /// A place within a site's share, from 0 to 1 along each axis.
  Vector<D> place(const Indices<D>& site, const Vector<D>& within) const
  {
    Vector<D> x;
    for (std::size_t k = 0; k < D; ++k) {
      const auto axis = static_cast<Eigen::Index>(k);
      x[axis] = lattice_.origin[axis] + lattice_.cell_size * ((site[k] + within[axis]) / lattice_.n_per_axis);
    }
    return x;
  }
  Vector<D> middle(const Indices<D>& site) const { return place(site, Vector<D>::Constant(0.5)); }

  std::vector<bool> corners_held(const Block<D>& corners) const
  {
    std::vector<bool> held(corners.size());
    for_each_index(corners.lower, corners.upper, [&](const Indices<D>& corner) {
      held[corners.number(corner)] = solid_.contains(place(corner, Vector<D>::Zero()));
    });
    return held;
  }

  /// How many of a site's corners and its middle the solid holds, for all sites.
  std::vector<int> corners_and_middles_held() const
  {
    Block<D> corners = sites_;
    for (int& upper : corners.upper) ++upper;
    const std::vector<bool> corner_is_held = corners_held(corners);
    std::vector<int> n_held(sites_.size());
    for_each_index(sites_.lower, sites_.upper, [&](const Indices<D>& site) {
      int& n = n_held[sites_.number(site)];
      n = solid_.contains(middle(site)) ? 1 : 0;
      for_each_index_below<D>(2, [&](const Indices<D>& corner) {
        Indices<D> i = site;
        for (std::size_t k = 0; k < D; ++k) i[k] += corner[k];
        n += corner_is_held[corners.number(i)] ? 1 : 0;
      });
    });
    return n_held;
  }

  /// Points are counted in those sites alone of whose corners and middle, and those of the sites across a side, some
  /// are held and some are not: the outline may bulge in between corners.
  void find_held()
  {
    const std::vector<int> n_held = corners_and_middles_held();
    for_each_index(sites_.lower, sites_.upper, [&](const Indices<D>& site) {
      const std::size_t number = sites_.number(site);
      bool is_cut = n_held[number] != 0 && n_held[number] != all_held;
      for (std::size_t k = 0; k < D; ++k) {
        for (const int step : {-1, 1}) {
          Indices<D> beside = site;
          beside[k] += step;
          is_cut |= sites_.contains(beside) && n_held[sites_.number(beside)] != n_held[number];
        }
      }
      const Held<D> held = is_cut ? held_of(site) : Held<D>{n_held[number] == 0 ? 0 : n_points};
      whole_[number] = held.n == n_points;
      if (held.n > 0 && held.n < n_points) cut_.emplace(number, held);
    });
  }

  Held<D> held_of(const Indices<D>& site) const
  {
    Held<D> held;
    for_each_index_below<D>(points_per_axis, [&](const Indices<D>& point) {
      Vector<D> within;
      for (std::size_t k = 0; k < D; ++k) within[static_cast<Eigen::Index>(k)] = (point[k] + 0.5) / points_per_axis;
      const Vector<D> x = place(site, within);
      if (solid_.contains(x)) held.add({1, x}, 1);
    });
    return held;
  }

  /// Gives slivers to the neighbours that hold the most, in equal parts, so that symmetric bodies stay symmetric.
  void give_away_slivers()
  {
    const std::unordered_map<std::size_t, Held<D>> before = cut_;
    const std::vector<bool> was_whole = whole_;
    for_each_index(sites_.lower, sites_.upper, [&](const Indices<D>& site) {
      const auto sliver = before.find(sites_.number(site));
      if (sliver == before.end() || sliver->second.n >= least) return;
      const std::vector<Indices<D>> takers = fullest_beside(site, before, was_whole);
      if (takers.empty()) return;
      for (const Indices<D>& taker : takers) {
        cut_at(taker).add(sliver->second, 1 / static_cast<double>(takers.size()));
      }
      cut_.erase(sites_.number(site));
    });
  }

  std::vector<Indices<D>> fullest_beside(const Indices<D>& site, const std::unordered_map<std::size_t, Held<D>>& cut,
                                         const std::vector<bool>& whole) const
  {
    std::vector<Indices<D>> fullest;
    double most = least;
    for_each_index_below<D>(3, [&](const Indices<D>& step) {
      Indices<D> beside = site;
      for (std::size_t k = 0; k < D; ++k) beside[k] += step[k] - 1;
      if (beside == site || !sites_.contains(beside)) return;
      const std::size_t number = sites_.number(beside);
      const auto at = cut.find(number);
      const double n = whole[number] ? n_points : at == cut.end() ? 0 : at->second.n;
      if (n < most) return;
      if (n > most) fullest.clear();
      most = n;
      fullest.push_back(beside);
    });
    return fullest;
  }

  Held<D>& cut_at(const Indices<D>& site)
  {
    const std::size_t number = sites_.number(site);
    if (whole_[number]) cut_[number] = {n_points, n_points * middle(site)};
    whole_[number] = false;
    return cut_[number];
  }

  static constexpr double least = 0.5 * n_points;

  const Solid<D>& solid_;
  const ParticleLattice<D>& lattice_;
  /// All sites, `n_per_axis` of them along each axis of a cell.
  Block<D> sites_;
  /// Sites whose share the solid holds as a whole; and among the others, those of which it holds a part.
  std::vector<bool> whole_;
  std::unordered_map<std::size_t, Held<D>> cut_;
};

template <int D>
bool hold_all_of(const CellRange<D>& cells, const ParticleLattice<D>& lattice, const Box<D>& box)
{
  for (std::size_t k = 0; k < D; ++k) {
    const auto axis = static_cast<Eigen::Index>(k);
    const double first = lattice.origin[axis] + lattice.cell_size * cells.lower[k];
    const double last = lattice.origin[axis] + lattice.cell_size * cells.upper[k];
    const double rounding = 1e-9 * lattice.cell_size;
    if (box.lower[axis] < first - rounding || box.upper[axis] > last + rounding) return false;
  }
  return true;
}

/// Scales the volumes of particles that are no whole shares, so that all together have the volume of the solid.
template <int D>
void scale_cut(double solid_volume, double share, std::vector<Site<D>>& particles)
{
  double whole = 0, cut = 0;
  for (const Site<D>& particle : particles) (particle.volume == share ? whole : cut) += particle.volume;
  if (cut == 0) return;
  for (Site<D>& particle : particles) {
    if (particle.volume != share) particle.volume *= (solid_volume - whole) / cut;
  }
}

/// The particles of all sites of which the solid holds a part. Not within `fill_cut`: its lambdas would have types that
/// other files can name.
template <int D>
std::vector<Site<D>> particles_of(const CutLattice<D>& cut, const ParticleLattice<D>& lattice,
                                  const CellRange<D>& range)
{
  const double share = lattice.particle_volume();
  std::vector<Site<D>> particles;
  for_each_index(range.lower, range.upper, [&](const Indices<D>& cell) {
    for_each_index_below<D>(lattice.n_per_axis, [&](const Indices<D>& site) {
      const Site<D> particle = cut.particle(cell, site);
      if (particle.volume > 0) particles.push_back({particle.place, particle.volume * share});
    });
  });
  return particles;
}

}  // namespace

template <int D>
std::vector<Site<D>> fill_cut(const Solid<D>& solid, const ParticleLattice<D>& lattice, const CellRange<D>& cells)
{
  lattice.check();
  const Box<D> box = solid.bounding_box();
  const CellRange<D> range = cells_near(box, lattice, cells);
  std::vector<Site<D>> particles = particles_of(CutLattice<D>(solid, lattice, range), lattice, range);
  const Volume volume = solid.volume();
  if (volume.is_exact() && hold_all_of(cells, lattice, box)) {
    scale_cut(volume.value, lattice.particle_volume(), particles);
  }
  return particles;
}

template std::vector<Site<2>> fill_cut(const Solid<2>&, const ParticleLattice<2>&, const CellRange<2>&);
template std::vector<Site<3>> fill_cut(const Solid<3>&, const ParticleLattice<3>&, const CellRange<3>&);

}  // namespace tamp::components
