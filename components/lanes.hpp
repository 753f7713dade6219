#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
#include <span>
#include <type_traits>
#include <utility>

namespace tamp
{

/// As many doubles as a register of the processor holds, worked on side by side: with it for a number, a formula
/// without branches serves that many particles at once, and each gets what it would get in any other company.
using Lanes = std::experimental::native_simd<double>;

inline constexpr std::size_t n_lanes = Lanes::size();

using std::sqrt;

/// The lanes of which `value(l)` gives each: built in a register, as a store of each by itself would hold up the load.
template <class Value>
Lanes each_lane(Value&& value)
{
  return Lanes([&](auto l) { return value(std::size_t{l}); });
}

/// The first n lanes.
inline Lanes::mask_type first_lanes(std::size_t n)
{
  return each_lane([](std::size_t l) { return static_cast<double>(l); }) < static_cast<double>(n);
}

/// How many lanes a condition holds for.
inline std::size_t count(const Lanes::mask_type& condition)
{
  return static_cast<std::size_t>(std::experimental::popcount(condition));
}

/// The whole part of each lane, which an int must hold: places in a table. (The library's own conversion draws the same
/// false warning as its square root, see below.)
inline std::array<std::int32_t, n_lanes> whole_parts(const Lanes& x)
{
  std::array<std::int32_t, n_lanes> whole;
  for (std::size_t l = 0; l < n_lanes; ++l) whole[l] = static_cast<std::int32_t>(x[l]);
  return whole;
}

inline std::array<std::int32_t, 1> whole_parts(double x)
{
  return {static_cast<std::int32_t>(x)};
}

/// The whole part as a number again.
inline double truncated(double x)
{
  return static_cast<std::int32_t>(x);
}
inline Lanes truncated(const Lanes& x)
{
  const std::array<std::int32_t, n_lanes> whole = whole_parts(x);
  return each_lane([&](std::size_t l) { return static_cast<double>(whole[l]); });
}

/// How many particles a number stands for, and that of one of them: for formulas of either double or Lanes.
template <class Number>
inline constexpr std::size_t n_lanes_of = 1;
template <>
inline constexpr std::size_t n_lanes_of<Lanes> = n_lanes;

inline double lane(double x, std::size_t /*l*/)
{
  return x;
}
inline double lane(const Lanes& x, std::size_t l)
{
  return x[l];
}

/// The number that has these lanes.
template <class Number>
Number number_of(const std::array<double, n_lanes_of<Number>>& lanes)
{
  if constexpr (n_lanes_of<Number> == 1) {
    return lanes[0];
  } else {
    return each_lane([&](std::size_t l) { return lanes[l]; });
  }
}

/// Which lanes a condition holds for; the plain bool where the number is one double.
template <class Number>
using Mask = decltype(std::declval<Number>() < std::declval<Number>());

inline double select(bool condition, double yes, double no)
{
  return condition ? yes : no;
}
inline Lanes select(const Lanes::mask_type& condition, const Lanes& yes, Lanes no)
{
#if defined(__clang__) && defined(__AVX512F__)
  // The library's own takes all lanes or none there (libstdc++ 12, simd_x86.h, _S_blend_avx512).
  return each_lane([&](std::size_t l) { return condition[l] ? yes[l] : no[l]; });
#else
  where(condition, no) = yes;
  return no;
#endif
}

/// Adds where the condition holds.
inline void add_where(const Lanes::mask_type& condition, const Lanes& value, Lanes& sum)
{
  sum = select(condition, sum + value, sum);
}

inline bool any(bool condition)
{
  return condition;
}
inline bool any(const Lanes::mask_type& condition)
{
  return std::experimental::any_of(condition);
}

inline bool is_finite(double x)
{
  return std::isfinite(x);
}
inline Lanes::mask_type is_finite(const Lanes& x)
{
  return std::experimental::isfinite(x);
}

using std::floor;
/// A loop for the same reason as that of the square root below.
inline Lanes floor(const Lanes& x)
{
  std::array<double, n_lanes> floors;
  for (std::size_t l = 0; l < n_lanes; ++l) floors[l] = std::floor(x[l]);
  return Lanes(floors.data(), std::experimental::element_aligned);
}

using std::abs;
inline Lanes abs(const Lanes& x)
{
  return std::experimental::abs(x);
}

/// std::max and std::min, whatever the number, and with their answer where one is no number.
template <class Number>
Number greater_of(const Number& a, const Number& b)
{
  return select(a < b, b, a);
}
template <class Number>
Number lesser_of(const Number& a, const Number& b)
{
  return select(b < a, b, a);
}
template <class Number>
Number clamped(const Number& x, const Number& low, const Number& high)
{
  return select(x < low, low, select(high < x, high, x));
}

/// A loop that compilers make one instruction: the library's own draws a false warning from gcc 12 (gcc bug 105593).
inline Lanes sqrt(const Lanes& x)
{
  std::array<double, n_lanes> roots;
  x.copy_to(roots.data(), std::experimental::element_aligned);
  for (double& root : roots) root = std::sqrt(root);
  return Lanes(roots.data(), std::experimental::element_aligned);
}

/// The lanes of numbers from `first` on; where they end, the last one again.
inline Lanes lanes_at(std::span<const double> numbers, std::size_t first)
{
  if (first + n_lanes <= numbers.size()) return Lanes(&numbers[first], std::experimental::element_aligned);
  return each_lane([&](std::size_t l) { return numbers[std::min(first + l, numbers.size() - 1)]; });
}

/// Writes them back, as many as there are numbers.
inline void set_lanes(std::span<double> numbers, std::size_t first, const Lanes& lanes)
{
  if (first + n_lanes <= numbers.size()) return lanes.copy_to(&numbers[first], std::experimental::element_aligned);
  for (std::size_t l = 0; first + l < numbers.size(); ++l) numbers[first + l] = lanes[l];
}

/// body(0), ..., body(n - 1), written out, so that arrays indexed by it can stay in registers.
template <std::size_t n, class Body>
inline void unrolled(const Body& body)
{
  [&]<std::size_t... i>(std::index_sequence<i...>)
  {
    (body(std::integral_constant<std::size_t, i>()), ...);
  }
  (std::make_index_sequence<n>());
}

namespace detail
{

using LanesVector [[gnu::vector_size(sizeof(Lanes))]] = double;

/// Swaps, of each two neighbouring blocks of `size` lanes, the second of `a` with the first of `b`.
template <std::size_t size, std::size_t... l>
inline void exchange_blocks(LanesVector& a, LanesVector& b, std::index_sequence<l...>)
{
  const LanesVector first = __builtin_shufflevector(a, b, ((l & size) != 0 ? n_lanes + l - size : l)...);
  b = __builtin_shufflevector(a, b, ((l & size) != 0 ? n_lanes + l : l + size)...);
  a = first;
}

/// The matrix of these rows is transposed: single numbers in each 2 x 2, then 2 x 2 in each 4 x 4, and so on.
template <std::size_t size = 1>
inline void transpose(std::array<LanesVector, n_lanes>& rows)
{
  if constexpr (size < n_lanes) {
    unrolled<n_lanes>([&](auto i) {
      if constexpr ((i & size) == 0) {
        exchange_blocks<size>(rows[i], rows[i + size], std::make_index_sequence<n_lanes>());
      }
    });
    transpose<2 * size>(rows);
  }
}

}  // namespace detail

/// n numbers that stand one after the other, for each lane at a place of its own: the first ones of all lanes, the
/// second ones, and so on.
template <std::size_t n>
inline std::array<Lanes, n> side_by_side(const std::array<const double*, n_lanes>& places)
{
  std::array<Lanes, n> numbers;
  constexpr std::size_t n_blocks = n / n_lanes;
  unrolled<n_blocks>([&](auto block) {
    constexpr std::size_t first = block * n_lanes;
    std::array<detail::LanesVector, n_lanes> rows;
    unrolled<n_lanes>([&](auto l) {
      rows[l] = std::bit_cast<detail::LanesVector>(Lanes(places[l] + first, std::experimental::element_aligned));
    });
    detail::transpose(rows);
    unrolled<n_lanes>([&](auto l) { numbers[first + l] = std::bit_cast<Lanes>(rows[l]); });
  });
  for (std::size_t i = n_blocks * n_lanes; i < n; ++i) {
    numbers[i] = each_lane([&](std::size_t l) { return places[l][i]; });
  }
  return numbers;
}
template <std::size_t n>
inline std::array<double, n> side_by_side(const std::array<const double*, 1>& place)
{
  std::array<double, n> numbers;
  std::copy_n(place[0], n, numbers.begin());
  return numbers;
}
template <std::size_t n, std::size_t n_rows>
inline auto side_by_side(const std::array<std::array<double, n>, n_rows>& rows)
{
  std::array<const double*, n_rows> places;
  for (std::size_t l = 0; l < n_rows; ++l) places[l] = rows[l].data();
  return side_by_side<n>(places);
}

/// Writes them back, to the first `n_places`.
template <std::size_t n>
inline void set_side_by_side(const std::array<Lanes, n>& numbers, const std::array<double*, n_lanes>& places,
                             std::size_t n_places)
{
  constexpr std::size_t n_blocks = n / n_lanes;
  unrolled<n_blocks>([&](auto block) {
    constexpr std::size_t first = block * n_lanes;
    std::array<detail::LanesVector, n_lanes> columns;
    unrolled<n_lanes>([&](auto l) { columns[l] = std::bit_cast<detail::LanesVector>(numbers[first + l]); });
    detail::transpose(columns);
    unrolled<n_lanes>([&](auto l) {
      if (l >= n_places) return;
      std::bit_cast<Lanes>(columns[l]).copy_to(places[l] + first, std::experimental::element_aligned);
    });
  });
  unrolled<n - n_blocks * n_lanes>([&](auto i) {
    unrolled<n_lanes>([&](auto l) {
      if (l < n_places) places[l][n_blocks * n_lanes + i] = numbers[n_blocks * n_lanes + i][l];
    });
  });
}

/// The numbers of each lane, one after the other.
template <std::size_t n>
inline std::array<std::array<double, n>, n_lanes> by_lane(const std::array<Lanes, n>& numbers)
{
  std::array<std::array<double, n>, n_lanes> rows;
  std::array<double*, n_lanes> places;
  for (std::size_t l = 0; l < n_lanes; ++l) places[l] = rows[l].data();
  set_side_by_side(numbers, places, n_lanes);
  return rows;
}

}  // namespace tamp

/// Lanes as the numbers of a matrix.
template <>
struct Eigen::NumTraits<tamp::Lanes> : Eigen::GenericNumTraits<tamp::Lanes> {
  using Real = tamp::Lanes;
  using Literal = double;
  enum {
    IsInteger = 0,
    IsSigned = 1,
    IsComplex = 0,
    RequireInitialization = 0,
    ReadCost = 1,
    AddCost = 1,
    MulCost = 1
  };
};
