#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "components/lanes.hpp"
#include "components/numbers.hpp"

namespace tamp
{

/// Particles of a tile, up to `size` of them, as columns of numbers and as packs that a register holds at a time.

/// A number of each particle of a tile. Padded, so that a register may begin at any particle, and as columns a power of
/// two apart would fall on the same lines of the cache.
template <std::size_t size>
using Column = std::array<double, size + 8>;

/// Particles that a register holds at a time, by their numbers in the tile; what is left over repeats the last.
struct Pack {
  std::array<std::uint32_t, n_lanes> of;
  std::size_t n;

  template <class Column>
  Lanes gathered(const Column& column) const
  {
    return each_lane([&](std::size_t l) { return column[of[l]]; });
  }
  /// Lanes that repeat the last particle write the same value.
  template <class Column>
  void scatter(const Lanes& values, Column& column) const
  {
    for (std::size_t l = 0; l < n_lanes; ++l) column[of[l]] = values[l];
  }
};

/// A column for each number of `Of`, a struct of numbers, for up to `size` particles.
template <template <class> class Of, std::size_t size>
class Columns
{
 public:
  Of<Lanes> at(const Pack& pack) const
  {
    Of<Lanes> values;
    std::size_t k = 0;
    for_each_number([&](Lanes& value) { value = pack.gathered(columns_[k++]); }, values);
    return values;
  }
  Of<double> at(std::size_t i) const
  {
    Of<double> values;
    std::size_t k = 0;
    for_each_number([&](double& value) { value = columns_[k++][i]; }, values);
    return values;
  }

  /// Values of neighbours, from particle `first` on; lanes beyond the tile's end are not written back.
  Of<Lanes> lanes_at(std::size_t first) const
  {
    Of<Lanes> values;
    std::size_t k = 0;
    for_each_number([&](Lanes& value) { value.copy_from(&columns_[k++][first], std::experimental::element_aligned); },
                    values);
    return values;
  }
  void set_lanes(std::size_t first, const Of<Lanes>& values)
  {
    std::size_t k = 0;
    for_each_number(
        [&](const Lanes& value) { value.copy_to(&columns_[k++][first], std::experimental::element_aligned); }, values);
  }

  void set(const Pack& pack, const Of<Lanes>& values)
  {
    std::size_t k = 0;
    for_each_number([&](const Lanes& value) { pack.scatter(value, columns_[k++]); }, values);
  }
  void set(std::size_t i, const Of<double>& values)
  {
    std::size_t k = 0;
    for_each_number([&](double value) { columns_[k++][i] = value; }, values);
  }

  /// The last of the numbers.
  double last(std::size_t i) const { return columns_.back()[i]; }

 private:
  std::array<Column<size>, count_numbers<Of<double>>()> columns_;
};

/// Calls `act` with packs of the numbers that `number(k)` gives, k from 0 to n.
template <class Number, class Act>
void for_each_pack(std::size_t n, const Number& number, const Act& act)
{
  for (std::size_t first = 0; first < n; first += n_lanes) {
    Pack pack;
    pack.n = std::min(n_lanes, n - first);
    for (std::size_t l = 0; l < n_lanes; ++l) {
      pack.of[l] = static_cast<std::uint32_t>(number(first + std::min(l, pack.n - 1)));
    }
    act(pack);
  }
}

/// A list of some of the particles.
template <std::size_t size>
class PackedList
{
 public:
  bool empty() const { return n_ == 0; }
  void clear() { n_ = 0; }

  /// Adds particle i if the condition holds, without a branch.
  void add_if(bool condition, std::size_t i)
  {
    of_[n_] = static_cast<std::uint32_t>(i);
    n_ += condition ? 1 : 0;
  }
  template <class Keep>
  void keep_if(const Keep& keep)
  {
    const std::size_t n = std::exchange(n_, 0);
    for (std::size_t k = 0; k < n; ++k) {
      const std::size_t i = of_[k];
      add_if(keep(i), i);
    }
  }

  template <class Act>
  void for_each(const Act& act) const
  {
    for (std::size_t k = 0; k < n_; ++k) act(std::size_t{of_[k]});
  }
  template <class Act>
  void for_each_pack(const Act& act) const
  {
    tamp::for_each_pack(
        n_, [&](std::size_t k) { return of_[k]; }, act);
  }

 private:
  std::array<std::uint32_t, size + 1> of_;
  std::size_t n_ = 0;
};

}  // namespace tamp
