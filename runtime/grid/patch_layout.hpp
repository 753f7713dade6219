#pragma once

#include <array>
#include <vector>

#include "runtime/grid/index_box.hpp"

namespace tamp::runtime
{

/// A uniform grid of cubic (in two dimensions square) cells over a box of space. Lengths in metres.
struct Grid {
  int dimension = 3;
  std::array<double, 3> lower{0, 0, 0};
  double cell_size = 1;
  Index n_cells{1, 1, 1};
  /// Along which axes the two ends of the grid are one place: what leaves at one enters at the other, and node n_cells
  /// is node 0.
  std::array<bool, 3> periodic{false, false, false};

  IndexBox cells() const { return {{0, 0, 0}, n_cells}; }
  /// Place along `axis` of node or cell face number `index`.
  double coordinate(int axis, int index) const { return lower[static_cast<std::size_t>(axis)] + cell_size * index; }
  double length(std::size_t axis) const { return cell_size * n_cells[axis]; }
  /// How many cells a place is beyond the lower end of an axis; and whether it is between the two ends, the lower one
  /// counting, which is false for what is not a number.
  double cells_from_lower(std::size_t axis, double x) const { return (x - lower[axis]) / cell_size; }
  bool spans(std::size_t axis, double x) const
  {
    const double place = cells_from_lower(axis, x);
    return place >= 0 && place < n_cells[axis];
  }
};

/// A patch as another one sees it, along a periodic axis perhaps beyond an end of the grid.
struct PatchImage {
  int patch = 0;
  /// The shift from its own indices to those there.
  Index shift{0, 0, 0};
};

/// A box of cells that is worked on as one: it owns its cells and the particles in them.
struct Patch {
  int id = 0;
  int rank = 0;
  IndexBox cells;
  /// Nodes of the cells, both ends counted: those on a seam belong to the patches of both sides.
  IndexBox nodes;
  /// Patches that touch this one by a face, an edge or a corner, ascending, without itself.
  std::vector<int> neighbours;
  /// Neighbours with their places, and the patch itself; along a periodic axis of one or two patches some come more
  /// than once. All that see a node see it in the same order: by patch, then by the node's index there.
  std::vector<PatchImage> images;
};

/// The grid cut into equal patches, numbered with x fastest.
class PatchLayout
{
 public:
  /// `n_patches` must divide the cells along each axis (std::invalid_argument otherwise).
  PatchLayout(const Grid& grid, const Index& n_patches);

  const Grid& grid() const { return grid_; }
  const Index& n_patches() const { return n_patches_; }
  int size() const { return static_cast<int>(patches_.size()); }
  const Patch& operator[](int id) const { return patches_[static_cast<std::size_t>(id)]; }
  /// Which rank works on which patch; all are rank 0's until this says otherwise. Throws std::invalid_argument unless
  /// it gives each patch to one of the ranks.
  void give_to_ranks(const std::vector<int>& rank_of_patch, int n_ranks);
  int n_ranks() const { return n_ranks_; }
  std::vector<int> ranks() const;

  auto begin() const { return patches_.begin(); }
  auto end() const { return patches_.end(); }

  /// The fewest cells that a patch has along an axis that is cut or periodic; the largest int when none is.
  int narrowest() const;
  /// The patch that owns a cell; -1 outside of the grid.
  int patch_of_cell(const Index& cell) const;
  /// Nodes that `patch` alone answers for: each node of the grid is in exactly one such box, those at the two ends of a
  /// periodic axis being the same.
  IndexBox owned_nodes(const Patch& patch) const;
  /// Owned nodes with the upper end of a periodic axis: each index of a node is in exactly one such box.
  IndexBox shown_nodes(const Patch& patch) const;

 private:
  void find_neighbours(Patch& patch) const;
  /// The number of a patch at a place among the patches, and back.
  int patch_at(const Index& place) const;
  Index place_of(int patch) const;

  Grid grid_;
  Index n_patches_;
  Index cells_per_patch_{};
  int n_ranks_ = 1;
  std::vector<Patch> patches_;
};

}  // namespace tamp::runtime
