#include "runtime/grid/patch_layout.hpp"

#include <limits>
#include <stdexcept>
#include <string>

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
  const IndexBox reach = grown(patch.cells, 1, 3);
  Index around{0, 0, 0};
  for (std::size_t k = 0; k < 3; ++k) around[k] = grid_.periodic[k] ? 1 : 0;
  const IndexBox laps{opposite(around), {around[0] + 1, around[1] + 1, around[2] + 1}};
  for (const Patch& other : patches_) {
    bool touches = false;
    for_each(laps, [&](const Index& lap) {
      // An image further down shows a node by a higher index, so it comes later.
      Index shift;
      for (std::size_t k = 0; k < 3; ++k) shift[k] = -lap[k] * grid_.n_cells[k];
      if (intersection(reach, moved(other.cells, shift)).empty()) return;
      touches = true;
      patch.images.push_back({other.id, shift});
    });
    if (touches && other.id != patch.id) patch.neighbours.push_back(other.id);
  }
}

void PatchLayout::give_to_ranks(const std::vector<int>& rank_of_patch, int n_ranks)
{
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
  return cell[0] / cells_per_patch_[0] +
         n_patches_[0] * (cell[1] / cells_per_patch_[1] + n_patches_[1] * (cell[2] / cells_per_patch_[2]));
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
