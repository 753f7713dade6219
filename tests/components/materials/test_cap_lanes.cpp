#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <numeric>
#include <optional>
#include <random>
#include <vector>

#include "components/materials/cap_integrator.hpp"
#include "tests/components/materials/concrete_sand.hpp"
#include "tests/components/materials/random_paths.hpp"

namespace test_cap_lanes
{

using namespace tamp;
using namespace tamp::components;

namespace
{

struct Strained {
  SymmetricTensor<3> stress;
  CapState state;
  SymmetricTensor<3> increment;
};

/// The results of a step, compared bit for bit.
using Numbers = std::array<double, 11>;

TabularCap sand_of(ElasticUpdate form, std::optional<double> dilation_limit)
{
  TabularCapParameters parameters = concrete_sand::sand(form).parameters();
  parameters.dilation_limit = dilation_limit;
  return TabularCap(parameters);
}

/// Particles on random paths, each at another place of its own, with steps from 1e-6 to 5 %.
std::vector<Strained> random_states(const TabularCap& sand, std::size_t n)
{
  std::mt19937_64 random(7);
  std::vector<Strained> states;
  while (states.size() < n) {
    random_paths::Increments increments(random);
    concrete_sand::Sample<3> sample;
    for (int step = 0; step < 40; ++step) {
      const SymmetricTensor<3> increment = increments.next();
      states.push_back({sample.stress, sample.state, increment});
      sample.strain(sand, increment);
    }
  }
  return states;
}

std::vector<Numbers> update_all(const TabularCap& sand, const std::vector<Strained>& from)
{
  const std::size_t n = from.size();
  std::vector<SymmetricTensor<3>> increment, stress;
  std::vector<CapState> state;
  for (const Strained& one : from) {
    increment.push_back(one.increment);
    stress.push_back(one.stress);
    state.push_back(one.state);
  }
  std::vector<double> bulk_modulus(n), shear_modulus(n), plastic_work(n);
  UpdateCounts counts;
  const MaterialBatch<3, CapState> batch{.strain_increment = increment,
                                         .deformation_gradient = {},
                                         .old_state = state,
                                         .stress = stress,
                                         .state = state,
                                         .bulk_modulus = bulk_modulus,
                                         .shear_modulus = shear_modulus,
                                         .plastic_work = plastic_work};
  REQUIRE(!update(sand, batch, counts));
  std::vector<Numbers> to;
  for (std::size_t i = 0; i < n; ++i) {
    const SymmetricTensor<3>& s = stress[i];
    const CapState& now = state[i];
    to.push_back({s[0], s[1], s[2], s[3], s[4], s[5], now.elastic_volumetric, now.plastic_volumetric,
                  now.equivalent_plastic, now.bulk_modulus, plastic_work[i]});
  }
  return to;
}

Numbers update_alone(CapIntegrator<UnloadingTable>& integrator, const Strained& from)
{
  const SymmetricTensor<3> s = deviator(from.stress), e = deviator(from.increment);
  const double e_j2 = 0.5 * double_dot(e, e), pressure = trace(from.stress) / -3.0;
  const CapStep<UnloadingTable>& step = integrator.step();
  CapParticle particle{.pressure = pressure,
                       .j2 = 0.5 * double_dot(s, s),
                       .mixed = double_dot(s, e),
                       .elastic_volumetric = from.state.elastic_volumetric,
                       .plastic_volumetric = from.state.plastic_volumetric,
                       .equivalent_plastic = from.state.equivalent_plastic,
                       .bulk_modulus = from.state.bulk_modulus};
  if (particle.bulk_modulus == 0) {
    particle.bulk_modulus = step.form() == ElasticUpdate::state ? step.model().at(0, 0).bulk_modulus
                                                                : step.model().rate_modulus(0.0, 0.0, 0.0);
  }
  const CapParticle now = integrator.advance(particle, {-trace(from.increment), e_j2, std::sqrt(e_j2)}).now;
  SymmetricTensor<3> stress = now.of_stress * s + now.of_strain * e;
  for (int k = 0; k < 3; ++k) stress[k] -= now.pressure;
  return {stress[0],
          stress[1],
          stress[2],
          stress[3],
          stress[4],
          stress[5],
          now.elastic_volumetric,
          now.plastic_volumetric,
          now.equivalent_plastic,
          now.bulk_modulus,
          now.plastic_work};
}

}  // namespace

TEST_CASE("in lanes the sand's update gives every particle the bits that the reference gives it alone")
{
  const TabularCap sand = sand_of(GENERATE(ElasticUpdate::rate, ElasticUpdate::state),
                                  GENERATE(std::optional<double>(), std::optional(0.01)));
  const std::vector<Strained> states = random_states(sand, 3001);
  const std::vector<Numbers> together = update_all(sand, states);

  CapIntegrator integrator(sand, std::get<UnloadingTable>(sand.parameters().modulus));
  for (std::size_t i = 0; i < states.size(); ++i) REQUIRE(together[i] == update_alone(integrator, states[i]));
}

TEST_CASE("in whatever order particles of sand come, each gets the same bits")
{
  const TabularCap sand = concrete_sand::sand(GENERATE(ElasticUpdate::rate, ElasticUpdate::state));
  const std::vector<Strained> states = random_states(sand, 1000);
  const std::vector<Numbers> in_order = update_all(sand, states);

  std::vector<std::size_t> order(states.size());
  std::iota(order.begin(), order.end(), 0);
  std::shuffle(order.begin(), order.end(), std::mt19937_64(3));
  std::vector<Strained> shuffled;
  shuffled.reserve(order.size());
  for (std::size_t i : order) shuffled.push_back(states[i]);
  const std::vector<Numbers> out_of_order = update_all(sand, shuffled);
  for (std::size_t k = 0; k < order.size(); ++k) REQUIRE(out_of_order[k] == in_order[order[k]]);
}

}  // namespace test_cap_lanes
