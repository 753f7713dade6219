#include "runtime/storage/checksum.hpp"

// Compiled into the runtime, so that who uses it installed needs no xxHash.
#define XXH_INLINE_ALL
#include <xxhash.h>

namespace tamp::runtime
{

std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t before)
{
  return XXH3_64bits_withSeed(bytes.data(), bytes.size(), before);
}

}  // namespace tamp::runtime
