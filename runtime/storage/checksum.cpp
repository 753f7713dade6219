#include "runtime/storage/checksum.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstring>

namespace tamp::runtime
{

namespace
{

/// The golden ratio's digits: odd, with its bits well spread.
constexpr std::uint64_t factor = 0x9e3779b97f4a7c15;

/// For either argument held fixed no two values of the other give the same, so that a difference never gets lost.
constexpr std::uint64_t mixed(std::uint64_t sum, std::uint64_t word)
{
  return std::rotl((sum ^ word) * factor, 29);
}

/// Words go to four sums in turn, which a processor works on at the same time.
using Sums = std::array<std::uint64_t, 4>;

void take(Sums& sums, const std::byte* block)
{
  Sums words;
  std::memcpy(words.data(), block, sizeof words);
  for (std::size_t i = 0; i < words.size(); ++i) sums[i] = mixed(sums[i], words[i]);
}

}  // namespace

std::uint64_t checksum(std::span<const std::byte> bytes)
{
  Sums sums{factor, 2 * factor, 3 * factor, 4 * factor};
  std::size_t at = 0;
  for (; at + sizeof sums <= bytes.size(); at += sizeof sums) take(sums, bytes.data() + at);
  std::array<std::byte, sizeof sums> rest{};
  std::copy(bytes.begin() + static_cast<std::ptrdiff_t>(at), bytes.end(), rest.begin());
  take(sums, rest.data());
  std::uint64_t all = bytes.size();
  for (const std::uint64_t sum : sums) all = mixed(all, sum);
  all = (all ^ (all >> 32)) * factor;
  return all ^ (all >> 29);
}

}  // namespace tamp::runtime
