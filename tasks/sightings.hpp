#pragma once

#include <array>
#include <cstdint>

namespace tamp::tasks
{

/// How often something was seen that a user should know of, and where first.
struct Sightings {
  std::int64_t count = 0;
  std::int64_t first_step = -1;  ///< -1: never
  double first_time = 0;         ///< s
  /// -1 where no single particle was to blame, or none of one material.
  std::int64_t particle = -1;
  int material = -1;
  std::array<double, 3> position{};  ///< m

  /// One more, in the step after `n_steps`.
  void add(std::int64_t n_steps, double time)
  {
    if (count++ > 0) return;
    first_step = n_steps;
    first_time = time;
  }
  void blame(std::int64_t first_particle, int its_material, const std::array<double, 3>& its_position)
  {
    particle = first_particle;
    material = its_material;
    position = its_position;
  }
};

}  // namespace tamp::tasks
