#include <algorithm>
#include <catch2/catch.hpp>
#include <numeric>
#include <set>
#include <vector>

#include "runtime/storage/checksum.hpp"

namespace test_checksum
{

using namespace tamp::runtime;

namespace
{

std::vector<std::byte> counted(std::size_t n)
{
  std::vector<std::byte> bytes(n);
  for (std::size_t i = 0; i < n; ++i) bytes[i] = static_cast<std::byte>(i);
  return bytes;
}

}  // namespace

TEST_CASE("a checksum is xxHash's XXH3 of 64 bits")
{
  // From xxHash's own tests: of no bytes, with the seeds 0 and 0x9E3779B185EBCA8D.
  CHECK(checksum({}) == 0x2D06800538D394C2U);
  CHECK(checksum({}, 0x9E3779B185EBCA8DU) == 0xA8A6B918B2F0364AU);
}

TEST_CASE("every change of one bit changes the checksum, whatever the length")
{
  std::size_t n_unnoticed = 0;

  for (const std::size_t n : {1U, 7U, 8U, 31U, 32U, 33U, 64U, 100U}) {
    std::vector<std::byte> bytes = counted(n);
    const std::uint64_t sum = checksum(bytes);
    for (std::size_t bit = 0; bit < 8 * n; ++bit) {
      bytes[bit / 8] ^= std::byte{1} << (bit % 8);
      n_unnoticed += checksum(bytes) == sum;
      bytes[bit / 8] ^= std::byte{1} << (bit % 8);
    }
  }

  CHECK(n_unnoticed == 0);
}

TEST_CASE("bytes that were cut off, that are zero, or that changed places change the checksum")
{
  std::set<std::uint64_t> sums;
  std::size_t n_different = 0;

  for (std::size_t n = 0; n < 200; ++n) {
    sums.insert(checksum(std::vector<std::byte>(n)));
    ++n_different;
  }
  for (std::size_t shift = 1; shift < 160; ++shift) {
    std::vector<std::byte> bytes = counted(160);
    std::rotate(bytes.begin(), bytes.begin() + static_cast<std::ptrdiff_t>(shift), bytes.end());
    sums.insert(checksum(bytes));
    ++n_different;
  }

  CHECK(sums.size() == n_different);
}

}  // namespace test_checksum
