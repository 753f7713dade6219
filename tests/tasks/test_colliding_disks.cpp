#include <catch2/catch.hpp>

#include "tests/tasks/scenes.hpp"

namespace test_colliding_disks
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Two soft disks run at each other along the diagonal of a box of 1 m (Sulsky, Chen & Schreyer 1994, section 7.3).
Scene disks(int n_cells, const components::ContactNormal& normal)
{
  Scene scene = empty_scene(2, {n_cells, n_cells, 1}, 1.0 / n_cells);
  scene.n_patches = {2, 2, 1};
  scene.time.multiplier = 0.5;
  const int a = add_elastic(scene, 1000, 1000, 0.3), b = add_elastic(scene, 1000, 1000, 0.3);
  add_disk(scene, a, 0.3, 0.3, 0.2, {0.1, 0.1, 0});
  add_disk(scene, b, 0.7, 0.7, 0.2, {-0.1, -0.1, 0});
  scene.contacts.push_back({a, b, 0, normal});
  return scene;
}

}  // namespace

namespace
{

struct Rebound {
  double least_kinetic = 1;
  double kinetic = 0;
  double elastic = 0;
  /// Largest difference of all energy, stored and turned to heat, from that of the start.
  double imbalance = 0;
};

/// 3 s of the collision; energies over that of the start.
Rebound rebound(int n_cells, const components::ContactNormal& normal)
{
  const auto simulation = Simulation::make(disks(n_cells, normal), 2);
  const double energy = simulation->report().kinetic;
  const double momentum = std::sqrt(0.5) * 0.2 * simulation->report().bodies[0].mass;
  Rebound seen;
  while (simulation->time() < 3) {
    const double elastic_before = simulation->energies().elastic;
    simulation->advance(3);
    const ParticleReport now = simulation->report();
    REQUIRE(now.momentum().norm() < 1e-12 * momentum);
    // One disk moves as the mirror image of the other at the middle of the box.
    REQUIRE((now.bodies[0].position + now.bodies[1].position - now.bodies[0].mass * Eigen::Vector3d(1, 1, 0)).norm() <
            1e-10 * now.bodies[0].mass);
    seen.kinetic = now.kinetic / energy;
    seen.elastic = simulation->energies().elastic / energy;
    seen.least_kinetic = std::min(seen.least_kinetic, seen.kinetic);
    // Velocities, and so kinetic energy, are of the middle of the step.
    const double all =
        now.kinetic + worked(simulation->energies()) - 0.5 * (simulation->energies().elastic - elastic_before);
    seen.imbalance = std::max(seen.imbalance, std::abs(all / energy - 1));
  }
  CHECK(simulation->report().bodies[0].momentum[0] < -0.8 * 0.1 * simulation->report().bodies[0].mass);
  return seen;
}

}  // namespace

TEST_CASE("disks rebound with their momentum, symmetry and nearly all their energy")
{
  const auto normal = GENERATE(components::ContactNormal(components::FlatterNormal()),
                               components::ContactNormal(components::RegressionNormal()));
  const Rebound coarse = rebound(20, normal), fine = rebound(40, normal);

  // At the turn all but the swinging within the disks is stored, and comes back as motion and vibration.
  CHECK(fine.least_kinetic < 0.05);
  CHECK(fine.kinetic + fine.elastic > 0.9);
  CHECK(fine.kinetic + fine.elastic < 1);
  // Particles filter what nodes gain, and lose energy in proportion to the cell size.
  CHECK(fine.imbalance < 0.1);
  CHECK(fine.imbalance / coarse.imbalance == Approx(0.5).margin(0.1));
}

}  // namespace test_colliding_disks
