#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "components/tensors.hpp"

namespace tamp::tasks
{

/// A particle, or a node where two materials meet, and where it is.
struct ParticlePlace {
  std::int64_t particle = -1;  ///< its id, or the number of the node; -1: none
  int material = -1;
  std::array<double, 3> position{};  ///< m
  int other_material = -1;           ///< at a node, the second of the two

  /// By id; none comes last.
  bool operator<(const ParticlePlace& other) const
  {
    return static_cast<std::uint64_t>(particle) < static_cast<std::uint64_t>(other.particle);
  }
};

template <int D>
ParticlePlace place_of(std::int64_t particle, int material, const Vector<D>& x)
{
  ParticlePlace place{particle, material, {}};
  std::copy(x.begin(), x.end(), place.position.begin());
  return place;
}

/// How often something was seen that a user should know of, and where first.
struct Occurrences {
  std::int64_t count = 0;
  std::int64_t first_step = -1;  ///< after so many steps; -1: never
  double first_time = 0;         ///< s
  /// The first one to blame, if a particle is.
  ParticlePlace first;

  void add(std::int64_t n_steps, double time, const ParticlePlace& place = {})
  {
    if (count++ > 0) return;
    first_step = n_steps;
    first_time = time;
    first = place;
  }
};

}  // namespace tamp::tasks
