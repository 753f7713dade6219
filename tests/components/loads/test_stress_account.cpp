#include "components/loads/stress_account.hpp"

#include <catch2/catch.hpp>
#include <random>
#include <vector>

namespace tamp::components::test_stress_account
{

namespace
{

constexpr std::size_t room = 32;

/// Particles of sand that is squeezed and sheared a little, and one in seven that has separated.
struct Particles {
  explicit Particles(std::size_t n)
  {
    std::mt19937 random(7);
    const auto number = [&](double least, double most) {
      return std::uniform_real_distribution<double>(least, most)(random);
    };
    for (std::size_t p = 0; p < n; ++p) {
      mass.push_back(number(1e-3, 2e-3));
      velocity.push_back({number(-100, 100), number(-100, 100)});
      old_volume.push_back(number(9e-7, 1e-6));
      volume.push_back(old_volume.back() * number(0.99, 1.01));
      for (auto* tensors : {&strain, &old_stress, &stress}) {
        const double scale = tensors == &strain ? 1e-2 : 1e6;
        SymmetricTensor<2> tensor;
        for (Eigen::Index k = 0; k < tensor.size(); ++k) tensor[k] = scale * number(-1, 1);
        tensors->push_back(tensor);
      }
      old_viscous_pressure.push_back(number(0, 1e5));
      own_stiffness.push_back(number(0, 4));
      bulk_modulus.push_back(p % 7 == 3 ? 0.0 : number(1e7, 1e9));
      shear_modulus.push_back(0.5 * bulk_modulus.back());
      plastic_work.push_back(number(0, 1e3));
    }
  }

  StressedBatch<2> from(std::size_t first, std::size_t n) const
  {
    const auto part = [&](const auto& values) { return std::span(values).subspan(first, n); };
    return {.mass = part(mass),
            .velocity = part(velocity),
            .old_volume = part(old_volume),
            .volume = part(volume),
            .strain_increment = part(strain),
            .old_stress = part(old_stress),
            .stress = part(stress),
            .old_viscous_pressure = part(old_viscous_pressure),
            .own_stiffness = part(own_stiffness),
            .bulk_modulus = part(bulk_modulus),
            .shear_modulus = part(shear_modulus),
            .plastic_work = part(plastic_work)};
  }

  std::vector<double> mass, old_volume, volume, old_viscous_pressure, own_stiffness, bulk_modulus, shear_modulus,
      plastic_work;
  std::vector<Vector<2>> velocity;
  std::vector<SymmetricTensor<2>> strain, old_stress, stress;
};

AccountRules rules(StepRule rule)
{
  return {0.005, rule, ArtificialViscosity{0.2, 2}, 1.5};
}

}  // namespace

TEST_CASE("each particle's account has the same bits in a batch as alone")
{
  const StepRule rule = GENERATE(StepRule::published, StepRule::viscous);
  const Particles particles(19);
  StressAccount<room> together;
  std::vector<double> viscous_pressure(19);

  account_for_stress<2>(rules(rule), 1e-5, particles.from(0, 19), viscous_pressure, together);

  for (std::size_t p = 0; p < 19; ++p) {
    StressAccount<room> alone;
    double pressure = 0;
    account_for_stress<2>(rules(rule), 1e-5, particles.from(p, 1), std::span(&pressure, 1), alone);
    CHECK(pressure == viscous_pressure[p]);
    CHECK(alone.elastic[0] == together.elastic[p]);
    CHECK(alone.plastic[0] == together.plastic[p]);
    CHECK(alone.viscous[0] == together.viscous[p]);
    CHECK(alone.stress_work_at_end[0] == together.stress_work_at_end[p]);
    CHECK(alone.stable_step[0] == together.stable_step[p]);
  }
}

TEST_CASE("the work of stress over a step is stored, lost to plasticity and lost to viscosity")
{
  const double dt = 1e-5;
  const Particles particles(7);
  StressAccount<room> account;
  std::vector<double> q(7);

  account_for_stress<2>(rules(StepRule::viscous), dt, particles.from(0, 7), q, account);

  for (std::size_t p = 0; p < 7; ++p) {
    const double middle = 0.5 * (particles.old_volume[p] + particles.volume[p]);
    const double shrunk = particles.old_volume[p] - particles.volume[p];
    const SymmetricTensor<2> mean = 0.5 * (particles.old_stress[p] + particles.stress[p]);
    const double work = double_dot(mean, particles.strain[p]) * middle;
    CHECK(account.elastic[p] + account.plastic[p] == Approx(work));
    CHECK(account.plastic[p] == Approx(particles.plastic_work[p] * particles.volume[p]));
    CHECK(account.viscous[p] == Approx(0.5 * (particles.old_viscous_pressure[p] + q[p]) * shrunk));
    const double last = 0.5 * (double_dot(particles.stress[p], particles.strain[p]) * middle + q[p] * shrunk);
    CHECK(account.stress_work_at_end[p] == Approx(last));
    if (particles.bulk_modulus[p] == 0) CHECK(q[p] == 0);
  }
}

}  // namespace tamp::components::test_stress_account
