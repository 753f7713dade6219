#include "runtime/execute/clock_line.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "runtime/execute/clock.hpp"

namespace tamp::runtime
{

namespace
{

constexpr std::size_t n_trips = 32;

std::span<std::byte> bytes_of(std::uint64_t& value)
{
  return std::as_writable_bytes(std::span(&value, 1));
}

/// Signed, whichever is later.
std::int64_t difference(std::uint64_t a, std::uint64_t b)
{
  return static_cast<std::int64_t>(a - b);
}

bool may_be_equal(const ClockPair& pair)
{
  return std::abs(difference(pair.first_rank, pair.own)) <= static_cast<std::int64_t>(pair.uncertainty);
}

void answer(const Communicator& communicator, int rank)
{
  for (std::size_t k = 0; k < n_trips; ++k) {
    std::uint64_t question = 0;
    communicator.receive(rank, bytes_of(question));
    std::uint64_t now = ticks();
    communicator.send(rank, bytes_of(now));
  }
}

ClockPair ask(const Communicator& communicator)
{
  std::array<RoundTrip, n_trips> trips;
  for (RoundTrip& trip : trips) {
    trip.asked = ticks();
    communicator.send(0, bytes_of(trip.asked));
    communicator.receive(0, bytes_of(trip.answer));
    trip.heard = ticks();
  }
  return shortest_of(trips);
}

}  // namespace

ClockPair shortest_of(std::span<const RoundTrip> trips)
{
  const auto length = [](const RoundTrip& trip) { return trip.heard - trip.asked; };
  const RoundTrip& best = *std::min_element(
      trips.begin(), trips.end(), [&](const RoundTrip& a, const RoundTrip& b) { return length(a) < length(b); });
  const std::uint64_t half = length(best) / 2;
  return {best.asked + half, best.answer, length(best) - half};
}

ClockPair ask_first_rank(const Communicator& communicator)
{
  if (!communicator.is_first()) return ask(communicator);
  for (int rank = 1; rank < communicator.size(); ++rank) answer(communicator, rank);
  const std::uint64_t now = ticks();
  return {now, now, 0};
}

ClockLine::ClockLine(const ClockPair& begin, const ClockPair& end)
    : uncertainty_(std::max(begin.uncertainty, end.uncertainty))
{
  if (may_be_equal(begin) && may_be_equal(end)) return;
  own_ = begin.own;
  first_rank_ = begin.first_rank;
  const std::int64_t length = difference(end.own, begin.own);
  if (length <= 0) return;
  drift_ = static_cast<double>(difference(end.first_rank, begin.first_rank) - length) / static_cast<double>(length);
}

std::uint64_t ClockLine::first_rank(std::uint64_t own) const
{
  const std::int64_t since = difference(own, own_);
  // The drift alone is a fraction, so that long runs lose no tick to rounding.
  return first_rank_ + static_cast<std::uint64_t>(since + std::llround(drift_ * static_cast<double>(since)));
}

}  // namespace tamp::runtime
