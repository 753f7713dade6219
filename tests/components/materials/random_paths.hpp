#pragma once

#include <algorithm>
#include <cmath>
#include <random>

#include "components/materials/tabular_cap.hpp"
#include "tests/components/materials/one_particle.hpp"

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
  const tamp::components::Invariants at = tamp::components::invariants(stress);
  const double p = at.pressure, crush = sand.crush_pressure(state.plastic_volumetric);
  const double vertex = surface.vertex_pressure();
  return std::max({at.sqrt_j2() - surface.limit(p, crush), p - crush, vertex - p, 0.0}) / (crush - vertex);
}

inline void follow_one(const tamp::components::TabularCap& sand, std::mt19937_64& random, Outcome& outcome)
{
  constexpr int n_steps = 20;
  Increments increments(random);
  tamp::test::OneParticle<3, tamp::components::TabularCap> sample;
  for (int i = 0; i < n_steps; ++i) {
    const tamp::SymmetricTensor<3> increment = increments.next();
    sample.update(sand, increment);
    ++outcome.n_steps;
    const tamp::components::CapState& state = sample.state;
    const double sum = sample.stress.sum() + state.elastic_volumetric + state.plastic_volumetric +
                       state.equivalent_plastic + sample.bulk_modulus + sample.plastic_work;
    if (!(std::isfinite(sum) && sample.bulk_modulus > 0)) ++outcome.n_not_finite;
    outcome.outside = std::max(outcome.outside, outside(sand, sample.stress, state));
  }
  outcome.counts.add(sample.counts);
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
