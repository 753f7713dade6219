#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "runtime/storage/fields/field_columns.hpp"
#include "runtime/storage/hdf5.hpp"

namespace tamp::runtime
{

/// Place of the items that one rank gives in a dataset of all ranks.
struct ItemPlace {
  /// This rank's share of a dataset of scalars, an item each.
  hdf5::Share share;
  std::size_t n_own = 0;
  /// This rank's items in the order in which they stand in the file, which is how HDF5 takes those of many slabs.
  std::vector<RowRun> file_order;

  std::size_t n_total() const;
};

/// Throws std::invalid_argument for rows or boxes outside of the whole, or that are not as many as the block says.
ItemPlace place_of(const ParticleBlock& block);
ItemPlace place_of(const NodeBlock& block);

/// The share in a dataset of items of so many components.
hdf5::Share share_of(const ItemPlace& place, std::size_t n_components);

/// `values`, `n_components` for each of this rank's items, in the order of the file.
template <class T>
std::vector<T> in_file_order(std::vector<T> values, const ItemPlace& place, std::size_t n_components)
{
  if (place.file_order.size() <= 1) return values;
  std::vector<T> ordered;
  ordered.reserve(values.size());
  for (const RowRun& run : place.file_order) {
    const auto begin = values.begin() + static_cast<std::ptrdiff_t>(run.first * n_components);
    ordered.insert(ordered.end(), begin, begin + static_cast<std::ptrdiff_t>(run.n * n_components));
  }
  return ordered;
}

}  // namespace tamp::runtime
