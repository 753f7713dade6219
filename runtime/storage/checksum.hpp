#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tamp::runtime
{

/// 64 bits that tell bytes from damaged ones: a change within eight bytes that stand on a multiple of eight is found
/// for certain, any other but for one in 2^64. Of files, not of secrets.
std::uint64_t checksum(std::span<const std::byte> bytes);

}  // namespace tamp::runtime
