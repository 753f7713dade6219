#pragma once

#include <Eigen/Core>
#include <array>
#include <cmath>
#include <experimental/simd>

namespace tamp
{

/// As many doubles as a register of the processor holds, worked on side by side: with it for a number, a formula
/// without branches serves that many particles at once, and each gets what it would get in any other company.
using Lanes = std::experimental::native_simd<double>;

inline constexpr std::size_t n_lanes = Lanes::size();

using std::sqrt;

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
