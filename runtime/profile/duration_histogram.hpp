#pragma once

#include <array>
#include <cstdint>

namespace tamp::runtime
{

/// How long the instances of one task took, kept as counts by length: 32 bins an octave, so that a quantile is known
/// to about 2 %.
class DurationHistogram
{
 public:
  void add(std::uint64_t ticks);
  std::uint64_t count() const { return count_; }
  std::uint64_t total() const { return total_; }
  std::uint64_t least() const { return count_ == 0 ? 0 : least_; }
  std::uint64_t most() const { return most_; }
  void merge(const DurationHistogram& other);
  /// The length that a share of `q` (0..1) of all does not pass.
  double quantile(double q) const;

 private:
  static constexpr int bins_per_octave = 32;

  std::uint64_t count_ = 0;
  std::uint64_t total_ = 0;
  std::uint64_t least_ = ~std::uint64_t{0};
  std::uint64_t most_ = 0;
  std::array<std::uint32_t, 48 * bins_per_octave> bins_{};
};

}  // namespace tamp::runtime
