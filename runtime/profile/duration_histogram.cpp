#include "runtime/profile/duration_histogram.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstddef>

namespace tamp::runtime
{

void DurationHistogram::add(std::uint64_t ticks)
{
  ++count_;
  total_ += ticks;
  least_ = std::min(least_, ticks);
  most_ = std::max(most_, ticks);
  // The octave is the place of the top bit; the next five bits tell the bin within it.
  const std::uint64_t value = std::max<std::uint64_t>(ticks, bins_per_octave);
  const auto octave = static_cast<int>(std::bit_width(value)) - 1;
  const auto within = static_cast<std::size_t>(value >> (octave - 5)) % bins_per_octave;
  const auto bin = static_cast<std::size_t>(octave) * bins_per_octave + within;
  ++bins_[std::min(bin, bins_.size() - 1)];
}

void DurationHistogram::merge(const DurationHistogram& other)
{
  count_ += other.count_;
  total_ += other.total_;
  least_ = std::min(least_, other.least_);
  most_ = std::max(most_, other.most_);
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) bins_[bin] += other.bins_[bin];
}

double DurationHistogram::quantile(double q) const
{
  const double wanted = q * static_cast<double>(count_);
  double seen = 0;
  for (std::size_t bin = 0; bin < bins_.size(); ++bin) {
    seen += bins_[bin];
    if (seen < wanted || bins_[bin] == 0) continue;
    const auto octave = static_cast<int>(bin / bins_per_octave);
    const double within = (static_cast<double>(bin % bins_per_octave) + 0.5) / bins_per_octave;
    const double middle = std::ldexp(1 + within, octave);
    return std::clamp(middle, static_cast<double>(least()), static_cast<double>(most_));
  }
  return static_cast<double>(most_);
}

}  // namespace tamp::runtime
