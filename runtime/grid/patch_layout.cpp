#include "runtime/grid/patch_layout.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>

namespace tamp::runtime
{

PatchLayout::PatchLayout(const Grid& grid, const Index& n_patches) : grid_(grid), n_patches_(n_patches)
{
  for (std::size_t k = 0; k < 3; ++k) {
    if (n_patches[k] < 1 || grid.n_cells[k] % n_patches[k] != 0) {
      throw std::invalid_argument(std::to_string(n_patches[k]) + " patches do not divide " +
                                  std::to_string(grid.n_cells[k]) + " cells along axis " + std::to_string(k));
    }
    cells_per_patch_[k] = grid.n_cells[k] / n_patches[k];
  }
  for_each(IndexBox{{0, 0, 0}, n_patches}, [&](const Index& at) {
    Patch patch;
    patch.id = size();
    for (std::size_t k = 0; k < 3; ++k) {
      patch.cells.lower[k] = at[k] * cells_per_patch_[k];
      patch.cells.upper[k] = patch.cells.lower[k] + cells_per_patch_[k];
    }
    patch.nodes = patch.cells;
    for (std::size_t k = 0; k < static_cast<std::size_t>(grid.dimension); ++k) ++patch.nodes.upper[k];
    patches_.push_back(patch);
  });
  for (Patch& patch : patches_) find_neighbours(patch);
}

void PatchLayout::find_neighbours(Patch& patch) const
{
  const Index own = place_of(patch.id);
  for_each(IndexBox{{-1, -1, -1}, {2, 2, 2}}, [&](const Index& step) {
    PatchImage image;
    Index at{};
    for (std::size_t k = 0; k < 3; ++k) {
      at[k] = own[k] + step[k];
      if (at[k] >= 0 && at[k] < n_patches_[k]) continue;
      if (!grid_.periodic[k]) return;
      const int lap = at[k] < 0 ? -1 : 1;
      at[k] -= lap * n_patches_[k];
      image.shift[k] = lap * grid_.n_cells[k];
    }
    image.patch = patch_at(at);
    patch.images.push_back(image);
    if (image.patch != patch.id) patch.neighbours.push_back(image.patch);
  });
  // An image further down shows a node by a higher index, so it comes later.
  std::sort(patch.images.begin(), patch.images.end(), [](const PatchImage& a, const PatchImage& b) {
    return std::tie(a.patch, b.shift[2], b.shift[1], b.shift[0]) <
           std::tie(b.patch, a.shift[2], a.shift[1], a.shift[0]);
  });
  std::sort(patch.neighbours.begin(), patch.neighbours.end());
  patch.neighbours.erase(std::unique(patch.neighbours.begin(), patch.neighbours.end()), patch.neighbours.end());
}

int PatchLayout::patch_at(const Index& place) const
{
  return place[0] + n_patches_[0] * (place[1] + n_patches_[1] * place[2]);
}

Index PatchLayout::place_of(int patch) const
{
  return {patch % n_patches_[0], patch / n_patches_[0] % n_patches_[1], patch / (n_patches_[0] * n_patches_[1])};
}

void PatchLayout::give_to_ranks(const std::vector<int>& rank_of_patch, int n_ranks)
{
  if (rank_of_patch.size() != patches_.size()) {
    throw std::invalid_argument("ranks of " + std::to_string(rank_of_patch.size()) + " patches for a layout of " +
                                std::to_string(patches_.size()));
  }
  for (const int rank : rank_of_patch) {
    if (rank >= 0 && rank < n_ranks) continue;
    throw std::invalid_argument("a patch of rank " + std::to_string(rank) + ", where there are " +
                                std::to_string(n_ranks) + " from 0 on");
  }
  n_ranks_ = n_ranks;
  for (Patch& patch : patches_) patch.rank = rank_of_patch[static_cast<std::size_t>(patch.id)];
}

std::vector<int> PatchLayout::ranks() const
{
  std::vector<int> ranks;
  for (const Patch& patch : patches_) ranks.push_back(patch.rank);
  return ranks;
}

int PatchLayout::narrowest() const
{
  int cells = std::numeric_limits<int>::max();
  for (std::size_t k = 0; k < 3; ++k) {
    if (n_patches_[k] > 1 || grid_.periodic[k]) cells = std::min(cells, cells_per_patch_[k]);
  }
  return cells;
}

int PatchLayout::patch_of_cell(const Index& cell) const
{
  if (!grid_.cells().contains(cell)) return -1;
  return patch_at({cell[0] / cells_per_patch_[0], cell[1] / cells_per_patch_[1], cell[2] / cells_per_patch_[2]});
}

IndexBox PatchLayout::owned_nodes(const Patch& patch) const
{
  IndexBox nodes = shown_nodes(patch);
  for (std::size_t k = 0; k < 3; ++k) {
    if (grid_.periodic[k]) nodes.upper[k] = patch.cells.upper[k];
  }
  return nodes;
}

IndexBox PatchLayout::shown_nodes(const Patch& patch) const
{
  IndexBox nodes = patch.nodes;
  for (std::size_t k = 0; k < static_cast<std::size_t>(grid_.dimension); ++k) {
    if (patch.cells.upper[k] != grid_.n_cells[k]) --nodes.upper[k];
  }
  return nodes;
}

}  // namespace tamp::runtime
