#include "runtime/storage/fields/item_place.hpp"

#include <fmt/core.h>

#include <algorithm>
#include <stdexcept>

namespace tamp::runtime
{

namespace
{

/// Own items that follow each other in the file too.
struct PlacedRun {
  std::size_t first_in_file;
  RowRun own;
};

std::vector<RowRun> sorted_by_file(std::vector<PlacedRun> runs)
{
  std::sort(runs.begin(), runs.end(), [](const auto& a, const auto& b) { return a.first_in_file < b.first_in_file; });
  std::vector<RowRun> order;
  for (const PlacedRun& run : runs) {
    const bool follows = !order.empty() && order.back().first + order.back().n == run.own.first;
    if (!follows) order.push_back({run.own.first, 0});
    order.back().n += run.own.n;
  }
  return order;
}

hdf5::Slab slab_of(const IndexBox& box)
{
  hdf5::Slab slab;
  for (const std::size_t axis : {2U, 1U, 0U}) {
    slab.first.push_back(static_cast<hsize_t>(box.lower[axis]));
    slab.n.push_back(static_cast<hsize_t>(box.upper[axis] - box.lower[axis]));
  }
  return slab;
}

}  // namespace

std::size_t ItemPlace::n_total() const
{
  std::size_t n = 1;
  for (const hsize_t along_axis : share.dimensions) n *= along_axis;
  return n;
}

hdf5::Share share_of(const ItemPlace& place, std::size_t n_components)
{
  hdf5::Share share = place.share;
  if (n_components == 1) return share;
  share.dimensions.push_back(n_components);
  for (hdf5::Slab& slab : share.slabs) {
    slab.first.push_back(0);
    slab.n.push_back(n_components);
  }
  return share;
}

ItemPlace place_of(const ParticleBlock& block)
{
  const RowShare share = block.share.value_or(RowShare{block.n, {{0, block.n}}});
  if (share.n_own() != block.n) {
    throw std::invalid_argument(fmt::format("'{}': rows for {} of {} particles", block.name, share.n_own(), block.n));
  }
  ItemPlace place{{{share.n_total}, {}}, block.n, {}};
  std::vector<PlacedRun> runs;
  std::size_t own = 0;
  for (const RowRun& run : share.runs) {
    if (run.first + run.n > share.n_total) {
      throw std::invalid_argument(fmt::format("'{}': row {} of {}", block.name, run.first + run.n, share.n_total));
    }
    if (run.n == 0) continue;
    place.share.slabs.push_back({{run.first}, {run.n}});
    runs.push_back({run.first, {own, run.n}});
    own += run.n;
  }
  place.file_order = sorted_by_file(std::move(runs));
  return place;
}

ItemPlace place_of(const NodeBlock& block)
{
  const IndexBox all{{0, 0, 0}, block.n_nodes};
  const auto strides = all.strides();
  const hdf5::Slab whole = slab_of(all);
  ItemPlace place{{whole.n, {}}, 0, {}};
  std::vector<PlacedRun> runs;
  for (const IndexBox& box : block.boxes.value_or(std::vector{all})) {
    if (intersection(box, all) != box) throw std::invalid_argument("a box of nodes that leaves the grid");
    if (box.empty()) continue;
    place.share.slabs.push_back(slab_of(box));
    IndexBox starts = box;
    starts.upper[0] = starts.lower[0] + 1;
    for_each(starts, [&](const Index& i) {
      const std::ptrdiff_t first = i[0] + strides[1] * i[1] + strides[2] * i[2];
      const auto n = static_cast<std::size_t>(box.extent(0));
      runs.push_back({static_cast<std::size_t>(first), {place.n_own, n}});
      place.n_own += n;
    });
  }
  place.file_order = sorted_by_file(std::move(runs));
  return place;
}

}  // namespace tamp::runtime
