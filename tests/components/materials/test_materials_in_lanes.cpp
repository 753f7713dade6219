#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>
#include <random>
#include <string>
#include <utility>
#include <vector>

#include "components/lanes.hpp"
#include "components/materials/drucker_prager.hpp"
#include "components/materials/hypoelastic.hpp"
#include "components/materials/neo_hookean.hpp"
#include "components/materials/neo_hookean_log.hpp"
#include "tests/components/materials/one_particle.hpp"
#include "tests/same_bits.hpp"

namespace test_materials_in_lanes
{

using namespace tamp;
using namespace tamp::components;

namespace
{

template <int D, class Model>
using Particles = std::vector<test::OneParticle<D, Model>>;

/// At rest, sheared, in tension, far beyond strength, and what cannot be updated; `increments` likewise.
template <int D, class Model>
Particles<D, Model> particles(std::size_t n, std::vector<SymmetricTensor<D>>& increments)
{
  std::mt19937 random(9);
  std::normal_distribution<double> normal;
  Particles<D, Model> all(n);
  for (std::size_t i = 0; i < n; ++i) {
    SymmetricTensor<D> strain;
    for (int k = 0; k < n_symmetric<D>; ++k) {
      strain[k] = (i % 3 == 0 ? 1e-6 : 1e-3) * normal(random);
      all[i].stress[k] = i % 5 == 0 ? 0 : 2e5 * normal(random) - (k < 3 ? 3e5 : 0);
    }
    if (i % 7 != 0) {
      for (int k = 0; k < D * D; ++k) all[i].deformation_gradient.data()[k] += 0.1 * normal(random);
    }
    if (i % 10 == 0) strain.setZero();
    if (i % 41 == 0) strain[1] = i % 2 == 0 ? std::nan("") : std::numeric_limits<double>::infinity();
    if (i % 43 == 0) all[i].deformation_gradient(0, 0) = std::nan("");
    increments.push_back(strain);
  }
  return all;
}

/// All of a batch, in the order given.
template <int D, class Model>
std::pair<BatchFailure, UpdateCounts> update_together(const Model& model, Particles<D, Model>& all,
                                                      const std::vector<SymmetricTensor<D>>& increments,
                                                      const std::vector<std::size_t>& order)
{
  std::vector<SymmetricTensor<D>> strain, stress;
  std::vector<Matrix<D>> gradient;
  std::vector<typename Model::State> state;
  std::vector<double> opening;
  for (const std::size_t i : order) {
    strain.push_back(increments[i]);
    stress.push_back(all[i].stress);
    gradient.push_back(all[i].deformation_gradient);
    state.push_back(all[i].state);
    if (keeps_gaps(model)) opening.push_back(all[i].opening);
  }
  std::vector<double> bulk(order.size()), shear(order.size()), work(order.size());
  UpdateCounts counts;
  const MaterialBatch<D, typename Model::State> batch{strain, gradient, state, stress,  state,  bulk,
                                                      shear,  work,     {},    opening, opening};

  const BatchFailure failure = update(model, batch, counts);

  for (std::size_t k = 0; k < order.size(); ++k) {
    auto& particle = all[order[k]];
    particle.stress = stress[k];
    particle.state = state[k];
    if (keeps_gaps(model)) particle.opening = opening[k];
    particle.bulk_modulus = bulk[k];
    particle.shear_modulus = shear[k];
    particle.plastic_work = work[k];
  }
  return {failure, counts};
}

/// All numbers of a particle.
template <int D, class Model>
std::vector<double> numbers_of(const test::OneParticle<D, Model>& particle)
{
  std::vector<double> numbers(particle.stress.data(), particle.stress.data() + particle.stress.size());
  numbers.insert(numbers.end(), {particle.bulk_modulus, particle.shear_modulus, particle.plastic_work});
  if constexpr (std::is_same_v<typename Model::State, SoilState>) {
    numbers.insert(numbers.end(),
                   {particle.state.plastic_volumetric, particle.state.equivalent_plastic, particle.opening});
  }
  return numbers;
}

template <int D, class Model>
bool same_bits_of(const Particles<D, Model>& a, const Particles<D, Model>& b)
{
  for (std::size_t i = 0; i < a.size(); ++i) {
    const std::vector<double> one = numbers_of<D>(a[i]), other = numbers_of<D>(b[i]);
    if (!std::equal(one.begin(), one.end(), other.begin(), test::same_bits)) return false;
  }
  return true;
}

template <int D, class Model>
void check_any_order(const Model& model)
{
  std::vector<SymmetricTensor<D>> increments;
  Particles<D, Model> alone = particles<D, Model>(10 * n_lanes + 1, increments);
  Particles<D, Model> in_order = alone, shuffled = alone;
  std::vector<std::size_t> order(alone.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::size_t n_failures = 0;

  for (std::size_t i = 0; i < alone.size(); ++i) {
    if (alone[i].update(model, increments[i])) ++n_failures;
  }
  const auto [failure, counts] = update_together<D>(model, in_order, increments, order);
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  update_together<D>(model, shuffled, increments, order);

  CHECK(same_bits_of<D>(in_order, alone));
  CHECK(same_bits_of<D>(shuffled, alone));
  CHECK(counts.failures == n_failures);
  CHECK(failure.has_value() == (n_failures > 0));
}

template <class Model>
void check_any_order(const std::string& name, const Model& model)
{
  INFO(name);
  check_any_order<2>(model);
  check_any_order<3>(model);
}

const DruckerPrager soil{
    .bulk_modulus = 2e8, .shear_modulus = 1e8, .friction_angle = 30, .dilation_angle = 10, .cohesion = 1e4};

}  // namespace

TEST_CASE("particles of a batch have the bits of scalar code, in any order and beside any other")
{
  DruckerPrager cut_off = soil, cohesive = soil;
  cut_off.tension_cutoff = 5e3;
  cohesive.friction_angle = cohesive.dilation_angle = 0;

  check_any_order("hypoelastic", Hypoelastic{2e8, 1e8});
  check_any_order("neo hookean", NeoHookean{2e8, 1e8});
  check_any_order("of logarithmic form", NeoHookeanLog{2e8, 1e8});
  check_any_order("drucker prager", soil);
  check_any_order("with a cut-off", cut_off);
  check_any_order("without friction", cohesive);
  cut_off.separation = true;
  check_any_order("that may part", cut_off);
  check_any_order("mohr coulomb", MohrCoulomb{2e8, 1e8, 30, 10, 1e4});
  BoltonSand sand{2650, 0.6, 1, 32, 125, 0.05};
  sand.fill(1500);
  sand.choose_strength(false);
  check_any_order("bolton", sand);
}

TEST_CASE("soil of a batch returns to its cone as one particle after the other, with branches, does")
{
  DruckerPrager cut_off = soil;
  cut_off.tension_cutoff = 5e3;
  const double sine = 0.5, dilating = std::sin(10 * std::numbers::pi / 180);
  const double alpha = 2 * std::numbers::sqrt3 * sine / (3 - sine);
  const double beta = 2 * std::numbers::sqrt3 * dilating / (3 - dilating);
  const double cohesion = 2 * std::numbers::sqrt3 * 1e4 * std::sqrt(0.75) / (3 - sine);
  const double K = soil.bulk_modulus, G = soil.shear_modulus, tension = 5e3;

  std::vector<SymmetricTensor<3>> increments;
  Particles<3, DruckerPrager> all = particles<3, DruckerPrager>(500, increments);
  const Particles<3, DruckerPrager> old = all;
  std::vector<std::size_t> order(all.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  update_together<3>(cut_off, all, increments, order);

  std::array<int, 4> n_of_kind{};
  for (std::size_t i = 0; i < all.size(); ++i) {
    const SymmetricTensor<3> trial =
        old[i].stress + 2 * G * deviator(increments[i]) + isotropic<6>(K * trace(increments[i]));
    const Invariants at = invariants(trial);
    double p = at.pressure, tau = at.sqrt_j2(), shear = 0;
    if (!trial.allFinite()) {
      ++n_of_kind[0];
      CHECK(all[i].stress == old[i].stress);
      CHECK(all[i].plastic_work == 0);
      continue;
    }
    if (tau <= cohesion + alpha * p && p >= -tension) {
      ++n_of_kind[1];
    } else {
      shear = std::max(tau - cohesion - alpha * p, 0.0) / (G + alpha * beta * K);
      if (p + K * beta * shear >= -tension) {
        ++n_of_kind[2];
        p += K * beta * shear;
      } else {
        ++n_of_kind[3];
        shear = (tau - std::min(tau, cohesion - alpha * tension)) / G;
        p = -tension;
      }
      tau -= G * shear;
    }
    CHECK(all[i].pressure() == Approx(p).margin(1e-4));
    CHECK(all[i].sqrt_j2() == Approx(tau).margin(1e-3));
    CHECK(all[i].state.equivalent_plastic == Approx(shear / std::numbers::sqrt3).margin(1e-15));
  }
  for (const int n : n_of_kind) CHECK(n > 5);
}

}  // namespace test_materials_in_lanes
