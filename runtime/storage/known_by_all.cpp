#include "runtime/storage/known_by_all.hpp"

#include <cstring>
#include <span>

namespace tamp::runtime
{

std::vector<std::uint64_t> known_by_all(std::vector<std::uint64_t> own, const Communicator& communicator)
{
  std::vector<std::uint64_t> all(own.size(), 0);
  for (const std::vector<std::byte>& bytes : communicator.gather(std::as_bytes(std::span(own)))) {
    if (!own.empty()) std::memcpy(own.data(), bytes.data(), bytes.size());
    for (std::size_t i = 0; i < all.size(); ++i) all[i] |= own[i];
  }
  return all;
}

}  // namespace tamp::runtime
