#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace tamp::runtime
{

/// 64 bits that distinguish bytes from damaged ones, but for one change in 2^64: xxHash's XXH3, which is the same on
/// every processor. It guards files, not secrets. Where rows are summed one after another, `before` is the sum so far.
std::uint64_t checksum(std::span<const std::byte> bytes, std::uint64_t before = 0);

}  // namespace tamp::runtime
