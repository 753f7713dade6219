#include <catch2/catch.hpp>

#include <cmath>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_monitors
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A free block of rubber on 2 x 2 patches, 8 x 8 cells with 2 x 2 particles each.
Scene block()
{
  Scene scene = empty_scene(2, {16, 16, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  scene.limits.sampled_every = 5;
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), {0.4, 0.4, 0}, {1.2, 1.2, 0});
  return scene;
}

/// Two blocks that approach each other across a gap; cells are 0.1 m, and of 2 x 2 patches.
Scene two_blocks(double gap, const components::ContactNormal& normal)
{
  Scene scene = empty_scene(2, {16, 16, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  scene.limits.sampled_every = 5;
  const int lower = add_elastic(scene, 1000, 1e6, 0.3), upper = add_elastic(scene, 1000, 1e6, 0.3);
  add_box(scene, lower, {0.4, 0.4, 0}, {1.2, 0.8 - gap / 2, 0});
  add_box(scene, upper, {0.4, 0.8 + gap / 2, 0}, {1.2, 1.2, 0}, {0, -0.01, 0});
  scene.contacts.push_back({lower, upper, 0, normal});
  return scene;
}

/// A block that moves towards one wall, along an axis, across a gap; cells are 0.1 m, and of 2 x 2 patches.
Scene block_before_wall(double gap, int axis, const Face& wall)
{
  Scene scene = empty_scene(2, {16, 16, 1}, 0.1);
  scene.n_patches = {2, 2, 1};
  scene.limits.sampled_every = 5;
  const auto k = static_cast<std::size_t>(axis);
  scene.faces[k][0] = wall;
  Triple lower{0.4, 0.4, 0}, upper{1.2, 1.2, 0}, velocity{0, 0, 0};
  lower[k] = gap;
  upper[k] = gap + 0.4;
  velocity[k] = -0.1;
  add_box(scene, add_elastic(scene, 1000, 1e6, 0.3), lower, upper, velocity);
  // Walls are nothing to a rigid body.
  add_box(scene, add_elastic(scene, 8000, 1e9, 0.3), {1.3, 1.3, 0}, {1.5, 1.5, 0}).rigid = true;
  return scene;
}

/// Velocities of neighbours that cancel at every node.
double noise(const Vector<3>& x)
{
  const auto i = static_cast<long>(std::floor(x[0] / 0.05)), j = static_cast<long>(std::floor(x[1] / 0.05));
  return (i + j) % 2 == 0 ? 0.01 : -0.01;
}

/// A layer on a floor, on 2 x 2 patches, whose upper half flies up and falls back within 0.31 s.
Scene thrown_layer(const components::MaterialModel& model)
{
  Scene scene = empty_scene(2, {16, 16, 1}, 0.025);
  scene.n_patches = {2, 2, 1};
  add_walls(scene, 0);
  add_walls(scene, 1);
  scene.gravity = {0, -9.81, 0};
  scene.materials.push_back({"layer", 1600, model});
  add_box(scene, 0, {0, 0, 0}, {0.4, 0.05, 0});
  add_box(scene, 0, {0, 0.05, 0}, {0.4, 0.1, 0}, {0, 1.5, 0});
  return scene;
}

const components::DruckerPrager friction_alone{
    .bulk_modulus = 1e6, .shear_modulus = 6e5, .friction_angle = 35, .dilation_angle = 0, .cohesion = 0};

const MonitorRecords& records_after(Simulation& simulation, int n_steps)
{
  for (int n = 0; n < n_steps; ++n) simulation.advance(1e30);
  return simulation.monitors();
}

}  // namespace

TEST_CASE("motion that no node sees is all of the energy of noise with flip, and little of a wave")
{
  Scene noisy = block(), smooth = block();
  noisy.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(noise(x), 0, 0); };
  smooth.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(0.01 * std::sin(4 * x[0]), 0, 0); };

  const auto with_noise = Simulation::make(noisy, 1), with_wave = Simulation::make(smooth, 1);
  noisy.transfer = "apic";
  const auto filtered = Simulation::make(noisy, 1);

  CHECK(records_after(*with_noise, 20).null_space.all.value() > 0.9);
  CHECK(records_after(*with_wave, 20).null_space.all.value() < 0.05);
  CHECK(records_after(*filtered, 20).null_space.all.part == 0);
}

TEST_CASE("a share beyond its limit is counted in each sample, with the first")
{
  Scene scene = block();
  scene.limits.null_space = 0.5;
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(noise(x), 0, 0); };
  const auto simulation = Simulation::make(scene, 1);

  const Occurrences& above = records_after(*simulation, 22).null_space.above;

  CHECK(above.count == 4);
  CHECK(above.first_step == 5);
  CHECK(above.first_time > 0);
  CHECK(above.first_time < simulation->time());
}

TEST_CASE("pressure that goes from particle to particle is told from one that cells share")
{
  Scene scene = block();
  scene.materials[0].model = components::Hypoelastic{1e9, 1e5};
  // Bends, with a Poisson's ratio of 0.49995, so that particles of linear cells cannot keep their volume.
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(0, (x[0] - 0.8) * (x[0] - 0.8), 0); };
  const auto locking = Simulation::make(scene, 1);
  scene.anti_locking = AntiLocking::cell_average;
  const auto flowing = Simulation::make(scene, 1);

  CHECK(records_after(*locking, 100).uneven_pressure.all.value() > 0.5);
  CHECK(records_after(*flowing, 100).uneven_pressure.all.value() < 0.1);
}

TEST_CASE("particles are torn where tension holds them further apart than nodes reach")
{
  Scene scene = block();
  scene.materials[0].model = components::Hypoelastic{1e4, 1e4};
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(20 * (x[0] - 0.8), 0, 0); };
  const auto torn = Simulation::make(scene, 1);
  scene.interpolator = "cpdi";
  const auto stretched = Simulation::make(scene, 1);
  advance_to(*torn, 0.09);
  advance_to(*stretched, 0.09);

  const SampledShare& seen = torn->monitors().torn_apart;
  CHECK(seen.greatest > scene.limits.torn_apart);
  CHECK(seen.above.count > 0);
  CHECK(seen.above.first.particle >= 0);
  CHECK(seen.above.first.material == 0);
  CHECK(stretched->monitors().torn_apart.greatest == 0);
}

TEST_CASE("matter that has swollen by a fifth, and yet bears load, is told with its first particle")
{
  const auto swelling = Simulation::make(thrown_layer(friction_alone), 1),
             rubber = Simulation::make(thrown_layer(components::Hypoelastic{1e6, 6e5}), 1);
  // The monitor has the sum of the flaws that the fields of the particles show.
  double most = 0, greatest_load = 0;
  while (swelling->time() < 0.4) {
    swelling->advance(0.4);
    if (!swelling->scene().limits.samples_after(swelling->n_steps())) continue;
    const auto p = numbers_of(*swelling, "p"), J = numbers_of(*swelling, "J");
    double squared = 0, borne = 0, bearing = 0;
    for (std::size_t i = 0; i < p.size(); ++i) {
      borne += J[i] * std::max(p[i], 0.0);
      squared += J[i] * std::max(p[i], 0.0) * p[i];
    }
    if (borne > 0) greatest_load = std::max(greatest_load, squared / borne);
    for (std::size_t i = 0; i < p.size(); ++i) bearing += J[i] > 1.2 && p[i] > 0.01 * greatest_load ? 1 : 0;
    most = std::max(most, bearing / static_cast<double>(p.size()));
  }
  advance_to(*rubber, 0.4);

  const SampledShare& seen = swelling->monitors().swollen_load;
  CHECK(most > 0.3);
  CHECK(seen.greatest == Approx(most));
  CHECK(swelling->monitors().greatest_load == Approx(greatest_load));
  CHECK(seen.above.count > 0);
  CHECK(seen.above.first.particle >= 0);
  CHECK(rubber->monitors().greatest_load > 0);
  CHECK(rubber->monitors().swollen_load.greatest == 0);
}

TEST_CASE("contact is early where bodies push each other across a gap, and not where they lie on each other")
{
  const double gap = GENERATE(0.0, 0.1);
  const auto simulation = Simulation::make(two_blocks(gap, components::FlatterNormal()), 1);
  const auto by_regression = Simulation::make(two_blocks(gap, components::RegressionNormal()), 1);

  const SampledShare& seen = records_after(*simulation, 5).early_contact;

  CHECK(seen.all.whole > 0);
  CHECK(seen.all.value() == (gap > 0.05 ? 1 : 0));
  CHECK(seen.above.count == (gap > 0.05 ? 1 : 0));
  CHECK(seen.above.first.other_material == (gap > 0.05 ? 1 : -1));
  CHECK(records_after(*by_regression, 5).early_contact.all.whole == 0);
}

TEST_CASE("a wall stops early what it pushes across a gap, and not what lies on it")
{
  const double gap = GENERATE(0.0, 0.08);
  const int axis = GENERATE(0, 1);
  CAPTURE(gap, axis);
  const auto simulation = Simulation::make(block_before_wall(gap, axis, components::SymmetryFace()), 1);
  const auto at_edges = Simulation::make(block_before_wall(gap, axis, components::RoughWall{0, true}), 1);

  const SampledShare& seen = records_after(*simulation, 50).early_at_walls;

  CHECK(seen.all.whole > 0);
  CHECK(seen.all.value() == (gap > 0 ? 1 : 0));
  CHECK((seen.above.count > 0) == (gap > 0));
  CHECK((seen.above.first.particle >= 0) == (gap > 0));
  CHECK(records_after(*at_edges, 50).early_at_walls.all.whole == 0);
}

TEST_CASE("samples of walls are the same on any ranks and threads", "[ranks]")
{
  const Scene scene = block_before_wall(0.08, 1, components::SymmetryFace());
  const auto alone = Simulation::make(scene, 1);
  const SampledShare& expected = records_after(*alone, 50).early_at_walls;

  const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(2, on_shared_cores()),
                                           runtime::Communicator::world());
  const SampledShare& seen = records_after(*simulation, 50).early_at_walls;

  CHECK(expected.all.part > 0);
  CHECK(seen.all.part == expected.all.part);
  CHECK(seen.above.first.particle == expected.above.first.particle);
}

TEST_CASE("samples of the state are the same on any ranks and threads", "[ranks]")
{
  Scene scene = block();
  scene.bodies[0].functions.velocity = [](const Vector<3>& x) { return Vector<3>(noise(x), 20 * (x[1] - 0.8), 0); };
  const auto alone = Simulation::make(scene, 1);
  const MonitorRecords& expected = records_after(*alone, 30);

  const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(2, on_shared_cores()),
                                           runtime::Communicator::world());
  const MonitorRecords& records = records_after(*simulation, 30);

  CHECK(expected.null_space.all.part > 0);
  CHECK(records.null_space.all.part == expected.null_space.all.part);
  CHECK(records.uneven_pressure.all.part == expected.uneven_pressure.all.part);
  CHECK(records.torn_apart.all.part == expected.torn_apart.all.part);
}

TEST_CASE("samples of swollen matter are the same on any ranks and threads", "[ranks]")
{
  const Scene scene = thrown_layer(friction_alone);
  const auto alone = Simulation::make(scene, 1);
  advance_to(*alone, 0.35);
  const SampledShare& expected = alone->monitors().swollen_load;

  const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(2, on_shared_cores()),
                                           runtime::Communicator::world());
  advance_to(*simulation, 0.35);
  const SampledShare& seen = simulation->monitors().swollen_load;

  CHECK(expected.all.part > 0);
  CHECK(seen.all.part == expected.all.part);
  CHECK(seen.greatest == expected.greatest);
  CHECK(seen.above.first.particle == expected.above.first.particle);
}

TEST_CASE("samples of contact are the same on any ranks and threads", "[ranks]")
{
  const Scene scene = two_blocks(0.1, components::FlatterNormal());
  const auto alone = Simulation::make(scene, 1);
  const SampledShare& expected = records_after(*alone, 10).early_contact;

  const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(2, on_shared_cores()),
                                           runtime::Communicator::world());
  const SampledShare& seen = records_after(*simulation, 10).early_contact;

  CHECK(expected.all.part > 0);
  CHECK(seen.all.part == expected.all.part);
  CHECK(seen.all.whole == expected.all.whole);
  CHECK(seen.above.first.particle == expected.above.first.particle);
  CHECK(seen.above.first.position == expected.above.first.position);
}

}  // namespace test_monitors
