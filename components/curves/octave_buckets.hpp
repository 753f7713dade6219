#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <experimental/simd>

#include "components/lanes.hpp"

namespace tamp::components
{

/// Cuts a range of numbers into buckets that are found without a search: evenly spaced in each octave of the distance
/// from the range's start plus a shift, of which the leading bits are the bucket, the others the place in it. With a
/// shift as wide as the range they are evenly spaced in all of it; a smaller one makes them narrower towards the start.
class OctaveBuckets
{
 public:
  /// 2^octave_bits buckets an octave; `shift` is positive.
  OctaveBuckets(double first, double last, double shift, int octave_bits)
      : first_(first), width_(last - first), shift_(shift), place_bits_(mantissa_bits - octave_bits)
  {
    first_bucket_ = std::bit_cast<std::uint64_t>(shift_) >> place_bits_;
  }

  /// The bucket of a number, the first or last for one outside the range; the first for what is no number.
  std::size_t of(double x) const { return (bits(shifted(x)) >> place_bits_) - first_bucket_; }

  std::array<std::size_t, n_lanes> of(const Lanes& x) const
  {
    const auto buckets = (bits(shifted(x)) >> place_bits_) - first_bucket_;
    std::array<std::size_t, n_lanes> of_lane;
    for (std::size_t l = 0; l < n_lanes; ++l) of_lane[l] = buckets[l];
    return of_lane;
  }

  /// How far a number is from the start of its bucket towards the next's.
  template <class Number>
  Number place(const Number& x) const
  {
    const auto one = std::bit_cast<std::uint64_t>(1.0);
    return number((bits(shifted(x)) << (mantissa_bits - place_bits_) & mantissa) | one) - 1.0;
  }

  /// The lower end of a bucket.
  double start(std::size_t bucket) const
  {
    return std::bit_cast<double>((first_bucket_ + bucket) << place_bits_) - shift_ + first_;
  }

  std::size_t size() const { return of(first_ + width_) + 1; }

 private:
  static constexpr int mantissa_bits = 52;
  static constexpr std::uint64_t mantissa = (std::uint64_t{1} << mantissa_bits) - 1;
  using LaneBits = std::experimental::rebind_simd_t<std::uint64_t, Lanes>;

  static std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }
  static LaneBits bits(const Lanes& x) { return std::bit_cast<LaneBits>(x); }
  static double number(std::uint64_t x) { return std::bit_cast<double>(x); }
  static Lanes number(const LaneBits& x) { return std::bit_cast<Lanes>(x); }

  template <class Number>
  Number shifted(const Number& x) const
  {
    const Number from_first = x - first_;
    // Written so that what is no number gives zero.
    return lesser_of<Number>(select(from_first > 0.0, from_first, Number(0.0)), width_) + shift_;
  }

  double first_, width_, shift_;
  int place_bits_;
  std::uint64_t first_bucket_;
};

}  // namespace tamp::components
