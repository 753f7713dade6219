#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "components/materials/tabular_cap.hpp"

/// Random strain paths for a sand, and what its update makes of them.
namespace random_paths
{

struct Outcome {
  std::size_t n_steps = 0;
  tamp::components::UpdateCounts counts;
  std::size_t n_not_finite = 0;  ///< steps that end with a number that is none, or with a modulus that is not positive
  double outside = 0;  ///< the farthest that stress gets outside of the yield surface, over the surface's length
};

/// Increments of random direction, and of a size spread evenly over its logarithm up to 5 %. Some paths are drawn
/// towards compaction, some towards tension, some nowhere; one step in five reverses the step before it.
class Increments
{
 public:
  explicit Increments(std::mt19937_64& random) : random_(random)
  {
    drift_ = std::discrete_distribution<int>({2, 1, 1})(random) == 0 ? -1.0 : unit_(random) < 0.5 ? 0.5 : 0.0;
  }

  tamp::SymmetricTensor<3> next()
  {
    constexpr double largest = 0.05, smallest = 1e-6, most_compaction = 0.45;
    if (unit_(random_) < 0.2) {
      last_ = -last_;
    } else {
      tamp::SymmetricTensor<3> direction;
      for (int i = 0; i < 6; ++i) direction[i] = normal_(random_);
      direction += tamp::isotropic<6>(drift_);
      const double size = largest * std::pow(smallest / largest, unit_(random_) * unit_(random_));
      last_ = direction * (size / std::sqrt(tamp::double_dot(direction, direction)));
    }
    if (compaction_ - tamp::trace(last_) > most_compaction) last_ = -last_;
    compaction_ -= tamp::trace(last_);
    return last_;
  }

 private:
  std::mt19937_64& random_;
  std::normal_distribution<double> normal_{0, 1};
  std::uniform_real_distribution<double> unit_{0, 1};
  double drift_, compaction_ = 0;
  tamp::SymmetricTensor<3> last_{tamp::SymmetricTensor<3>::Zero()};
};

inline double outside(const tamp::components::TabularCap& sand, const tamp::SymmetricTensor<3>& stress,
                      const tamp::components::CapState& state)
{
  const tamp::components::YieldSurface& surface = sand.parameters().yield;
  const tamp::SymmetricTensor<3> s = tamp::deviator(stress);
  const double p = -tamp::trace(stress) / 3, sqrt_j2 = std::sqrt(0.5 * tamp::double_dot(s, s));
  const double crush = sand.crush_pressure(state.plastic_volumetric), vertex = surface.vertex_pressure();
  return std::max({sqrt_j2 - surface.limit(p, crush), p - crush, vertex - p, 0.0}) / (crush - vertex);
}

inline void follow_one(const tamp::components::TabularCap& sand, std::mt19937_64& random, Outcome& outcome)
{
  constexpr int n_steps = 20;
  Increments increments(random);
  tamp::SymmetricTensor<3> stress = tamp::SymmetricTensor<3>::Zero();
  tamp::components::CapState state;
  for (int i = 0; i < n_steps; ++i) {
    const tamp::SymmetricTensor<3> increment = increments.next();
    double bulk_modulus = 0, plastic_work = 0;
    tamp::components::update<3>(sand, {&increment, 1}, {&state, 1}, {&stress, 1}, {&state, 1}, {&bulk_modulus, 1},
                                {&plastic_work, 1}, outcome.counts);
    ++outcome.n_steps;
    const double sum = stress.sum() + state.elastic_volumetric + state.plastic_volumetric + state.equivalent_plastic +
                       bulk_modulus + plastic_work;
    if (!(std::isfinite(sum) && bulk_modulus > 0)) ++outcome.n_not_finite;
    outcome.outside = std::max(outcome.outside, outside(sand, stress, state));
  }
}

/// Paths of 20 steps from fresh sand.
inline Outcome follow(const tamp::components::TabularCap& sand, int n_paths)
{
  std::mt19937_64 random(20210706);
  Outcome outcome;
  for (int i = 0; i < n_paths; ++i) follow_one(sand, random, outcome);
  return outcome;
}

}  // namespace random_paths
