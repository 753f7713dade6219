#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace tamp::runtime
{

/// The steps of a run in consecutive parts of equal length, of which there are at most 64: a run that outgrows them has
/// parts of twice as many steps.
class RunParts
{
 public:
  static constexpr std::size_t most = 64;

  /// Whether parts must be joined in pairs before this step, the next, belongs to one.
  bool outgrown_by(long step) const { return step == static_cast<long>(most) * steps_each_; }
  void join_pairs() { steps_each_ *= 2; }
  std::size_t part_of(long step) const { return static_cast<std::size_t>(step / steps_each_); }
  long steps_each() const { return steps_each_; }
  /// How many steps of a run of so many are in each part; the last may have fewer.
  std::vector<long> steps_of_parts(long n_steps) const
  {
    std::vector<long> steps;
    for (long first = 0; first < n_steps; first += steps_each_) steps.push_back(std::min(steps_each_, n_steps - first));
    return steps;
  }

 private:
  long steps_each_ = 1;
};

/// Ticks in each part of a run.
struct TicksOverTime {
  std::array<std::uint64_t, RunParts::most> of_part{};

  void join_pairs()
  {
    constexpr std::size_t half = RunParts::most / 2;
    for (std::size_t k = 0; k < half; ++k) of_part[k] = of_part[2 * k] + of_part[2 * k + 1];
    std::fill(of_part.begin() + half, of_part.end(), std::uint64_t{0});
  }
  void add(const TicksOverTime& other)
  {
    for (std::size_t k = 0; k < of_part.size(); ++k) of_part[k] += other.of_part[k];
  }
};

}  // namespace tamp::runtime
