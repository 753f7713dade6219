#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <vector>

#include "runtime/grid/patch_layout.hpp"
#include "runtime/ranks/communicator.hpp"

namespace tamp::runtime
{

/// Brings bytes that belong to patches to the first rank, into `all`, patch after patch: `n_bytes[p]` of patch p, as
/// all ranks know. `own` has those of this rank's patches, in the order of the patches. Collective.
void gather_by_patch(std::span<const std::byte> own, std::span<std::byte> all, std::span<const std::uint64_t> n_bytes,
                     const PatchLayout& layout, const Communicator& communicator);

/// Gathers values, `n_values[p]` of patch p: those of all patches on the first rank, and nothing on others.
template <class T>
std::vector<T> gather_by_patch(std::vector<T> own, std::span<const std::uint64_t> n_values, const PatchLayout& layout,
                               const Communicator& communicator)
{
  static_assert(std::is_trivially_copyable_v<T>);
  if (communicator.size() == 1) return own;
  std::vector<std::uint64_t> n_bytes;
  std::size_t n_all = 0;
  for (const std::uint64_t n : n_values) {
    n_bytes.push_back(n * sizeof(T));
    n_all += n;
  }
  std::vector<T> all(communicator.is_first() ? n_all : 0);
  gather_by_patch(std::as_bytes(std::span(own)), std::as_writable_bytes(std::span(all)), n_bytes, layout, communicator);
  return all;
}

}  // namespace tamp::runtime
