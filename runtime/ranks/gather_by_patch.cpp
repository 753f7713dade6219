#include "runtime/ranks/gather_by_patch.hpp"

#include <algorithm>

namespace tamp::runtime
{

namespace
{

std::size_t bytes_of_rank(int rank, std::span<const std::uint64_t> n_bytes, const PatchLayout& layout)
{
  std::size_t n = 0;
  for (const Patch& patch : layout) {
    if (patch.rank == rank) n += n_bytes[static_cast<std::size_t>(patch.id)];
  }
  return n;
}

/// Puts what a rank has where its patches are among all.
void place(int rank, std::span<const std::byte> of_rank, std::span<std::byte> all,
           std::span<const std::uint64_t> n_bytes, const PatchLayout& layout)
{
  std::size_t from = 0, to = 0;
  for (const Patch& patch : layout) {
    const std::size_t n = n_bytes[static_cast<std::size_t>(patch.id)];
    if (patch.rank == rank) {
      std::ranges::copy(of_rank.subspan(from, n), all.begin() + static_cast<std::ptrdiff_t>(to));
      from += n;
    }
    to += n;
  }
}

}  // namespace

void gather_by_patch(std::span<const std::byte> own, std::span<std::byte> all, std::span<const std::uint64_t> n_bytes,
                     const PatchLayout& layout, const Communicator& communicator)
{
  if (!communicator.is_first()) return communicator.send(0, own);
  place(0, own, all, n_bytes, layout);
  std::vector<std::byte> theirs;
  for (int rank = 1; rank < communicator.size(); ++rank) {
    theirs.resize(bytes_of_rank(rank, n_bytes, layout));
    communicator.receive(rank, theirs);
    place(rank, theirs, all, n_bytes, layout);
  }
}

}  // namespace tamp::runtime
