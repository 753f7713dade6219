#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace tamp::tools::bench
{

/// Patches in a row, dealt to the ranks in equal stretches. Each has a row of values, which the patches on both sides
/// read: what goes from rank to rank in a step is one row each way.
struct PatchRow {
  int n_ranks = 1;
  int patches_per_rank = 1;
  int n_values = 1;

  int n_patches() const { return n_ranks * patches_per_rank; }
  int first_of(int rank) const { return rank * patches_per_rank; }
};

/// The tasks of one rank's patches: each checks the stamp in all values that it reads, runs the kernel, and leaves a
/// stamp of its own in all values of its patch, one number for (step, patch).
class StampedRow
{
 public:
  using Values = std::span<const std::uint64_t>;

  explicit StampedRow(const PatchRow& shape) : shape_(shape) {}

  const PatchRow& shape() const { return shape_; }
  /// Work of each task; 0 for an empty body.
  int kernel_iterations = 0;

  /// Values of a patch when a step, counted from 0, begins.
  std::uint64_t stamp(long step, int patch) const
  {
    return static_cast<std::uint64_t>(step) * static_cast<std::uint64_t>(shape_.n_patches()) +
           static_cast<std::uint64_t>(patch) + 1;
  }
  /// `before` is not looked at on the first patch of the row, nor is `after` on the last.
  void run(long step, int patch, Values before, Values own, Values after, std::span<std::uint64_t> made) noexcept;
  /// The first wrong value that any task has read so far; empty if none.
  std::string fault() const;

 private:
  PatchRow shape_;
  long wrong_step_ = -1;
  int wrong_patch_ = -1;
  double value_ = 0;
};

}  // namespace tamp::tools::bench
