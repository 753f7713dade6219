#include <catch2/catch.hpp>

#include <algorithm>
#include <optional>
#include <random>
#include <span>
#include <vector>

#include "components/kinematics/deform.hpp"
#include "components/kinematics/strain_increment.hpp"

namespace test_deform
{

using namespace tamp;
using namespace tamp::components;

namespace
{

/// Particles with random deformations, stresses and steps; every fifth is almost flat.
template <int D>
struct Particles {
  std::vector<Matrix<D>> g, old_gradient;
  std::vector<double> old_volume;
  std::vector<SymmetricTensor<D>> old_stress;

  explicit Particles(int n)
  {
    std::mt19937 random(3);
    std::uniform_real_distribution<double> uniform(-1, 1);
    const auto any = [&] { return Matrix<D>(Matrix<D>::NullaryExpr([&] { return uniform(random); })); };
    for (int p = 0; p < n; ++p) {
      g.push_back(0.05 * any());
      old_gradient.push_back(Matrix<D>::Identity() + 0.2 * any());
      if (p % 5 == 1) old_gradient.back().row(D - 1) *= 1e-7;
      old_volume.push_back(2 + uniform(random));
      old_stress.push_back(SymmetricTensor<D>::NullaryExpr([&] { return uniform(random); }));
    }
  }

  void turn_inside_out(std::size_t p) { g[p] = -1.5 * Vector<D>::Unit(0) * Vector<D>::Unit(0).transpose(); }
};

/// `n` particles from `first` on, deformed.
template <int D>
struct Deformed {
  std::vector<Matrix<D>> gradient;
  std::vector<double> volume;
  std::vector<SymmetricTensor<D>> stress, strain;
  std::optional<std::size_t> inside_out;

  Deformed(const Particles<D>& particles, std::size_t first, std::size_t n,
           DeformationUpdate update = DeformationUpdate("exact"))
      : gradient(n), volume(n), stress(n), strain(n)
  {
    const auto some = [&](const auto& values) { return std::span(values).subspan(first, n); };
    inside_out = deform<D>(update, {.g = some(particles.g),
                                    .old_gradient = some(particles.old_gradient),
                                    .old_volume = some(particles.old_volume),
                                    .old_stress = some(particles.old_stress),
                                    .deformation_gradient = gradient,
                                    .volume = volume,
                                    .stress = stress,
                                    .strain_increment = strain});
  }
};

}  // namespace

TEMPLATE_TEST_CASE_SIG("particles are deformed together as each alone by its strain increment", "", ((int D), D), 2, 3)
{
  const Particles<D> particles(101);
  const DeformationUpdate update =
      GENERATE(DeformationUpdate("exact"), DeformationUpdate("first_order"), DeformationUpdate("exponential"));

  const Deformed<D> deformed(particles, 0, 101, update);

  CHECK_FALSE(deformed.inside_out);
  for (std::size_t p = 0; p < 101; ++p) {
    const auto alone = with_update(update, [&]<class Update>(const Update&) {
      return strain_increment<D, Update>(particles.old_gradient[p], particles.g[p]);
    });
    const SymmetricTensor<D> turned = rotated<D>(particles.old_stress[p], alone.rotation_increment);
    REQUIRE((deformed.gradient[p] - alone.deformation_gradient).norm() < 1e-15);
    REQUIRE((deformed.strain[p] - alone.strain_increment).norm() < 1e-14);
    REQUIRE((deformed.stress[p] - turned).norm() < 3e-14);
    REQUIRE(deformed.volume[p] == Approx(particles.old_volume[p] * alone.volume_ratio).epsilon(1e-15));
  }
}

TEMPLATE_TEST_CASE_SIG("the bits of a deformed particle do not depend on those around it", "", ((int D), D), 2, 3)
{
  const Particles<D> particles(40);
  const Deformed<D> together(particles, 0, 40);

  for (std::size_t p = 0; p < 40; ++p) {
    const Deformed<D> apart(particles, p, std::min<std::size_t>(40 - p, 1 + p % 5));
    REQUIRE(apart.gradient[0] == together.gradient[p]);
    REQUIRE(apart.volume[0] == together.volume[p]);
    REQUIRE(apart.stress[0] == together.stress[p]);
    REQUIRE(apart.strain[0] == together.strain[p]);
  }
}

TEMPLATE_TEST_CASE_SIG("the first particle that is turned inside out is named, wherever it stands", "", ((int D), D), 2,
                       3)
{
  Particles<D> particles(19);
  for (const std::size_t last : {18UL, 12UL, 5UL, 0UL}) {
    particles.turn_inside_out(last);
    CHECK(Deformed<D>(particles, 0, 19).inside_out == last);
  }
}

}  // namespace test_deform
