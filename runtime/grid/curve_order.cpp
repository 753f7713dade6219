#include "runtime/grid/curve_order.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>

namespace tamp::runtime
{

namespace
{

using Coordinates = std::array<std::uint32_t, 3>;

/// Where a Hilbert curve through a cube of 2^bits places a side passes `x`: J. Skilling, Programming the Hilbert curve,
/// AIP Conf. Proc. 707, 381 (2004). The number's bits come out spread over the coordinates and are put together last.
std::uint64_t place_on_curve(Coordinates x, int bits)
{
  const std::uint32_t top = 1U << (bits - 1);
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    const std::uint32_t below = bit - 1;
    for (std::uint32_t& along : x) {
      if ((along & bit) != 0) {
        x[0] ^= below;
      } else {
        const std::uint32_t differ = (x[0] ^ along) & below;
        x[0] ^= differ;
        along ^= differ;
      }
    }
  }
  x[1] ^= x[0];
  x[2] ^= x[1];
  std::uint32_t flips = 0;
  for (std::uint32_t bit = top; bit > 1; bit >>= 1) {
    if ((x[2] & bit) != 0) flips ^= bit - 1;
  }
  std::uint64_t place = 0;
  for (std::uint32_t bit = top; bit > 0; bit >>= 1) {
    for (const std::uint32_t along : x) place = 2 * place + (((along ^ flips) & bit) != 0 ? 1 : 0);
  }
  return place;
}

}  // namespace

std::vector<int> curve_order(const Index& n)
{
  const auto longest = static_cast<unsigned>(*std::max_element(n.begin(), n.end()));
  const int bits = std::max(1, static_cast<int>(std::bit_width(longest - 1)));
  std::vector<std::pair<std::uint64_t, int>> places;
  for_each(IndexBox{{0, 0, 0}, n}, [&](const Index& at) {
    Coordinates x{};
    std::copy(at.begin(), at.end(), x.begin());
    places.emplace_back(place_on_curve(x, bits), static_cast<int>(places.size()));
  });
  std::sort(places.begin(), places.end());
  std::vector<int> order;
  order.reserve(places.size());
  for (const auto& [place, number] : places) order.push_back(number);
  return order;
}

}  // namespace tamp::runtime
