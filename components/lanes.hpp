#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <cstdint>
#include <experimental/simd>
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

/// The whole part of each lane, which an int must hold: places in a table. (The library's own conversion draws the same
/// false warning as its square root, see below.)
inline std::array<std::int32_t, n_lanes> whole_parts(const Lanes& x)
{
  std::array<std::int32_t, n_lanes> whole;
  for (std::size_t l = 0; l < n_lanes; ++l) whole[l] = static_cast<std::int32_t>(x[l]);
  return whole;
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
  where(condition, no) = yes;
  return no;
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
