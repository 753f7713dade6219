#include "components/materials/separation.hpp"

#include <algorithm>
#include <array>
#include <catch2/catch.hpp>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "tests/components/materials/concrete_sand.hpp"

namespace test_separation
{

using namespace tamp;
using namespace tamp::components;
using concrete_sand::Sample;

namespace
{

constexpr double vertex = -24.5e3;

/// Sand that separates below 0.8 of its initial density.
TabularCap parting_sand(ElasticUpdate form)
{
  TabularCapParameters parameters = concrete_sand::sand(form).parameters();
  parameters.separation_density = 0.8;
  return TabularCap(parameters);
}

/// A particle that is stretched evenly along D axes.
template <int D>
struct Stretched {
  Sample<D> sample{};
  double expansion = 0;  ///< ln(det F)
  double stored = 0;     ///< part of the work done on it that was not booked as plastic [J/m3]

  void stretch_to(const TabularCap& sand, double to)
  {
    SymmetricTensor<D> increment = SymmetricTensor<D>::Zero();
    increment.template head<D>().setConstant((to - expansion) / D);
    sample.deformation_gradient = Matrix<D>::Identity() * std::exp(to / D);
    const SymmetricTensor<D> before = sample.stress;
    sample.strain(sand, increment);
    const SymmetricTensor<D> mean = 0.5 * (before + sample.stress);
    stored += double_dot(mean, increment) - sample.plastic_work;
    expansion = to;
  }

  /// To the tension vertex in small steps, and on to exp(0.223) = 1.2498 times its volume.
  void stretch_until_almost_apart(const TabularCap& sand)
  {
    for (int k = 1; k <= 200; ++k) stretch_to(sand, 5e-6 * k);
    for (int k = 2; k <= 223; ++k) stretch_to(sand, 1e-3 * k);
  }

  bool is_apart() const { return sample.state.separation_volume > 0; }
};

template <int D>
void check_parting(const TabularCap& sand)
{
  Stretched<D> particle;
  particle.stretch_until_almost_apart(sand);
  const double modulus = sand.initial_moduli().bulk_modulus;
  CHECK_FALSE(particle.is_apart());
  CHECK(particle.sample.pressure() == Approx(vertex).epsilon(1e-9));
  CHECK(particle.stored == Approx(vertex * vertex / (2 * modulus)).margin(0.1));
  const double plastic = particle.sample.state.plastic_volumetric;

  particle.stretch_to(sand, 0.224);

  const CapState& state = particle.sample.state;
  CHECK(state.separation_volume == Approx(std::exp(0.224)).epsilon(2e-7));
  CHECK(state.elastic_volumetric == 0);
  CHECK(state.plastic_volumetric == Approx(plastic - 1e-3).epsilon(1e-9));
  CHECK(std::abs(particle.stored) < 0.1);
  const CapState parted = state;
  const SymmetricTensor<D> none = SymmetricTensor<D>::Zero();
  for (int k = 224; k <= 300; ++k) {
    REQUIRE(particle.sample.stress == none);
    REQUIRE(particle.sample.bulk_modulus == 0);
    REQUIRE(particle.sample.shear_modulus == 0);
    particle.stretch_to(sand, 1e-3 * k);
    REQUIRE(particle.sample.plastic_work == 0);
  }
  CHECK(state.plastic_volumetric == parted.plastic_volumetric);
  CHECK(state.equivalent_plastic == parted.equivalent_plastic);
  CHECK(particle.sample.counts.separations == 1);
  CHECK(particle.sample.counts.apart == 300 - 223);
}

template <int D>
void check_joining(const TabularCap& sand)
{
  Stretched<D> particle;
  particle.stretch_until_almost_apart(sand);
  for (const double expansion : {0.224, 0.26, 0.3, 0.26, 0.23}) particle.stretch_to(sand, expansion);
  CHECK(particle.is_apart());
  const CapState apart = particle.sample.state;

  particle.stretch_to(sand, 0.22);

  CHECK_FALSE(particle.is_apart());
  CHECK(particle.sample.stress.norm() == 0);
  CHECK(particle.sample.bulk_modulus == Approx(sand.initial_moduli().bulk_modulus));
  CHECK(particle.sample.state.elastic_volumetric == 0);
  CHECK(particle.sample.state.plastic_volumetric == Approx(apart.plastic_volumetric + 0.004).margin(3e-7));
  CHECK(particle.sample.state.equivalent_plastic == apart.equivalent_plastic);
  CHECK(std::abs(particle.stored) < 0.1);

  Sample<D> other;
  other.state.plastic_volumetric = apart.plastic_volumetric + 0.004;
  other.state.equivalent_plastic = apart.equivalent_plastic;
  other.deformation_gradient = particle.sample.deformation_gradient;
  SymmetricTensor<D> increment = SymmetricTensor<D>::Zero();
  increment[0] = -1e-4, increment[1] = 3e-5, increment[3] = 5e-5;
  for (int k = 0; k < 20; ++k) {
    particle.sample.strain(sand, increment);
    other.strain(sand, increment);
    REQUIRE(particle.sample.pressure() == Approx(other.pressure()).epsilon(1e-6));
    REQUIRE(particle.sample.sqrt_j2() == Approx(other.sqrt_j2()).epsilon(1e-6));
  }
  CHECK(other.pressure() > 1e4);
}

/// All in one batch, in the order given.
template <int D>
void update_together(const TabularCap& sand, std::vector<Sample<D>>& all,
                     const std::vector<SymmetricTensor<D>>& increments, const std::vector<std::size_t>& order)
{
  std::vector<SymmetricTensor<D>> increment, stress;
  std::vector<Matrix<D>> gradient;
  std::vector<CapState> state;
  for (const std::size_t i : order) {
    increment.push_back(increments[i]);
    stress.push_back(all[i].stress);
    gradient.push_back(all[i].deformation_gradient);
    state.push_back(all[i].state);
  }
  std::vector<double> bulk(order.size()), shear(order.size()), work(order.size());
  UpdateCounts counts;
  REQUIRE(
      !update(sand, MaterialBatch<D, CapState>{increment, gradient, state, stress, state, bulk, shear, work}, counts));
  for (std::size_t k = 0; k < order.size(); ++k) {
    Sample<D>& one = all[order[k]];
    one.stress = stress[k];
    one.state = state[k];
    one.bulk_modulus = bulk[k], one.shear_modulus = shear[k], one.plastic_work = work[k];
  }
}

template <int D>
std::vector<double> numbers_of(const std::vector<Sample<D>>& all)
{
  std::vector<double> numbers;
  for (const Sample<D>& one : all) {
    numbers.insert(numbers.end(), one.stress.data(), one.stress.data() + one.stress.size());
    const CapState& s = one.state;
    numbers.insert(numbers.end(), {one.bulk_modulus, one.shear_modulus, one.plastic_work, s.elastic_volumetric,
                                   s.plastic_volumetric, s.equivalent_plastic, s.bulk_modulus, s.separation_volume});
  }
  return numbers;
}

/// Whole and about to part, apart, and about to join.
template <int D>
void check_any_order(const TabularCap& sand)
{
  std::mt19937 random(5);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<Sample<D>> alone(600);
  std::vector<SymmetricTensor<D>> increments(alone.size());
  for (std::size_t i = 0; i < alone.size(); ++i) {
    for (int k = 0; k < n_symmetric<D>; ++k) increments[i][k] = 1e-5 * in(random) + (k < D && i % 2 == 0 ? 1e-4 : 0);
    alone[i].deformation_gradient *= std::pow(1.26 + 0.1 * in(random), 1.0 / D);
    alone[i].state.plastic_volumetric = -0.23;
    if (i % 3 == 0) {
      alone[i].state.separation_volume = 1.26F;
    } else {
      const double pressure = i % 3 == 1 ? vertex : 1e4;
      alone[i].state.elastic_volumetric = pressure / sand.initial_moduli().bulk_modulus;
      alone[i].stress = -isotropic<n_symmetric<D>>(sand.pressure(alone[i].state));
    }
  }
  std::vector<Sample<D>> in_order = alone, shuffled = alone;
  std::vector<std::size_t> order(alone.size());
  std::iota(order.begin(), order.end(), std::size_t{0});

  UpdateCounts counts;
  for (std::size_t i = 0; i < alone.size(); ++i) {
    alone[i].strain(sand, increments[i]);
    counts.add(alone[i].counts);
  }
  update_together<D>(sand, in_order, increments, order);
  std::shuffle(order.begin(), order.end(), std::mt19937(2));
  update_together<D>(sand, shuffled, increments, order);

  CHECK(numbers_of<D>(in_order) == numbers_of<D>(alone));
  CHECK(numbers_of<D>(shuffled) == numbers_of<D>(alone));
  CHECK(counts.separations > 20);
  CHECK(counts.apart > 20);
  CHECK(counts.apart < 180);
}

}  // namespace

TEST_CASE("sand stretched evenly separates at 0.8 of its density, without stress, stiffness and stored energy")
{
  const TabularCap sand = parting_sand(GENERATE(ElasticUpdate::rate, ElasticUpdate::state));

  check_parting<2>(sand);
  check_parting<3>(sand);
}

TEST_CASE("sand joins at the volume at which it parted, and is then sand of its plastic strain without stress")
{
  const TabularCap sand = parting_sand(GENERATE(ElasticUpdate::rate, ElasticUpdate::state));

  check_joining<2>(sand);
  check_joining<3>(sand);
}

TEST_CASE("sand that has joined separates again")
{
  const TabularCap sand = parting_sand(ElasticUpdate::rate);
  Stretched<3> particle;
  particle.stretch_until_almost_apart(sand);

  for (const double expansion : {0.3, 0.2, 0.21, 0.22}) particle.stretch_to(sand, expansion);
  CHECK_FALSE(particle.is_apart());
  particle.stretch_to(sand, 0.23);

  CHECK(particle.is_apart());
  CHECK(particle.sample.counts.separations == 2);
}

TEST_CASE("sand under pressure, or that bears shear, does not separate however thin it is")
{
  const TabularCap sand = parting_sand(GENERATE(ElasticUpdate::rate, ElasticUpdate::state));
  const auto thin = [&](double pressure) {
    Sample<3> sample;
    sample.deformation_gradient(0, 0) = 3;
    sample.state = sand.state_at_pressure(pressure, -1);
    sample.stress = -isotropic<6>(pressure);
    return sample;
  };

  Sample<3> pressed = thin(1e4), sheared = thin(0);
  pressed.strain(sand, isotropic<6>(5e-6));
  SymmetricTensor<3> along_x = SymmetricTensor<3>::Zero();
  along_x[0] = 1e-3, along_x[1] = along_x[2] = -4e-4;
  sheared.strain(sand, along_x);

  CHECK(pressed.pressure() > 0);
  CHECK(pressed.state.separation_volume == 0);
  CHECK(sheared.sqrt_j2() > 0);
  CHECK(sheared.state.separation_volume == 0);
  Sample<3> torn = thin(0);
  torn.strain(sand, isotropic<6>(1e-3));
  CHECK(torn.state.separation_volume > 2.999F);
}

TEST_CASE("sand that may not separate bears the tension of its vertex at any density")
{
  const TabularCap sand = concrete_sand::sand(ElasticUpdate::rate);
  Stretched<3> particle;

  for (int k = 1; k <= 100; ++k) particle.stretch_to(sand, 0.01 * k);

  CHECK(particle.sample.pressure() == Approx(vertex));
  CHECK_FALSE(particle.is_apart());
}

TEST_CASE("sand that is apart and sand that is whole have the same bits side by side as alone")
{
  const TabularCap sand = parting_sand(GENERATE(ElasticUpdate::rate, ElasticUpdate::state));

  check_any_order<2>(sand);
  check_any_order<3>(sand);
}

TEST_CASE("to sand that is apart no strain is too large, but one that is no number is refused")
{
  const TabularCap sand = parting_sand(ElasticUpdate::rate);
  Sample<3> sample;
  sample.state.separation_volume = 1.25F;
  sample.deformation_gradient(0, 0) = 1.3;
  CHECK_FALSE(sample.update(sand, isotropic<6>(-0.5)));

  SymmetricTensor<3> strain = SymmetricTensor<3>::Zero();
  strain[1] = sample.deformation_gradient(1, 1) = NAN;
  const BatchFailure failure = sample.update(sand, strain);

  REQUIRE(failure);
  CHECK(failure->fault == UpdateFault::not_finite);
  CHECK(sample.state.separation_volume == 1.25F);
  CHECK(sample.state.n_failures == 1);
}

TEST_CASE("sand that separates below none or above all of its density is refused")
{
  TabularCapParameters parameters = concrete_sand::sand(ElasticUpdate::rate).parameters();
  for (const double part : {0.0, -1.0, 1.001, static_cast<double>(NAN)}) {
    parameters.separation_density = part;
    CHECK_THROWS_AS(TabularCap(parameters), BadValue);
  }
}

TEST_CASE("a ring of sand parts and joins by its whole volume, of which its hoop's stretch is a part")
{
  const TabularCap sand = parting_sand(ElasticUpdate::state);
  Sample<2> ring;
  Sample<3> block;
  double hoop = 1;

  for (const double stretch : {1.0, -1.1, 1.1}) {
    for (int k = 0; k < 100; ++k) {
      SymmetricTensor<2> increment = SymmetricTensor<2>::Zero();
      increment.head<3>().setConstant(1e-3 * stretch);
      ring.deformation_gradient *= std::exp(increment[0]);
      hoop *= std::exp(increment[2]);
      block.deformation_gradient.diagonal() << ring.deformation_gradient(0, 0), ring.deformation_gradient(0, 0), hoop;
      block.strain(sand, (SymmetricTensor<3>() << increment[0], increment[1], increment[2], 0, 0, 0).finished());
      const MaterialBatch<2, CapState> batch{.strain_increment = {&increment, 1},
                                             .deformation_gradient = {&ring.deformation_gradient, 1},
                                             .old_state = {&ring.state, 1},
                                             .stress = {&ring.stress, 1},
                                             .state = {&ring.state, 1},
                                             .bulk_modulus = {&ring.bulk_modulus, 1},
                                             .shear_modulus = {&ring.shear_modulus, 1},
                                             .plastic_work = {&ring.plastic_work, 1},
                                             .hoop_stretch = {&hoop, 1}};
      REQUIRE(!update(sand, batch, ring.counts));
      REQUIRE((ring.state.separation_volume > 0) == (block.state.separation_volume > 0));
      REQUIRE((ring.stress - block.stress.head<4>()).norm() <= 1e-12 * block.stress.norm());
    }
  }
  CHECK(ring.counts.separations == 2);
}

}  // namespace test_separation
