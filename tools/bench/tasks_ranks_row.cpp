#include "tools/bench/tasks_ranks_row.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "tools/bench/tasks_kernel.hpp"

namespace tamp::tools::bench
{

namespace
{

/// Zero if all values are as expected.
std::uint64_t difference(StampedRow::Values values, std::uint64_t expected)
{
  std::uint64_t bits = 0;
  for (const std::uint64_t value : values) bits |= value ^ expected;
  return bits;
}

}  // namespace

void StampedRow::run(long step, int patch, Values before, Values own, Values after,
                     std::span<std::uint64_t> made) noexcept
{
  std::uint64_t wrong = difference(own, stamp(step, patch));
  if (patch > 0) wrong |= difference(before, stamp(step, patch - 1));
  if (patch + 1 < shape_.n_patches()) wrong |= difference(after, stamp(step, patch + 1));
  if (wrong != 0) {
    wrong_step_ = step;
    wrong_patch_ = patch;
  }
  if (kernel_iterations > 0) value_ = multiply_add_kernel(kernel_iterations);
  std::fill(made.begin(), made.end(), stamp(step + 1, patch));
}

std::string StampedRow::fault() const
{
  if (wrong_patch_ < 0) return {};
  return fmt::format("the task of step {}, patch {} read values of another step or patch", wrong_step_, wrong_patch_);
}

}  // namespace tamp::tools::bench
