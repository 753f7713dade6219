#include <catch2/catch.hpp>

#include <algorithm>
#include <cmath>
#include <vector>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_step_records
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// A soft block and one with a hundred times its moduli, apart from each other and on several patches each. If stirred
/// the stiff one moves within, and its particles differ.
Scene two_blocks(bool stirred)
{
  Scene scene = empty_scene(2, {24, 12, 1}, 0.1);
  scene.n_patches = {4, 2, 1};
  const int soft = add_elastic(scene, 1000, 1e6, 0.3), stiff = add_elastic(scene, 1000, 1e8, 0.3);
  add_box(scene, soft, {0.3, 0.4, 0}, {0.7, 0.8, 0});
  SceneBody& body = add_box(scene, stiff, {1.0, 0.4, 0}, {1.6, 0.8, 0});
  if (!stirred) return scene;
  body.functions.velocity = [](const Vector<3>& x) {
    return Vector<3>(0.1 * std::sin(5 * x[0] + 3 * x[1]), 0.1 * std::sin(4 * x[0] - 7 * x[1]), 0);
  };
  return scene;
}

void advance_by(Simulation& simulation, int n_steps)
{
  for (int n = 0; n < n_steps; ++n) simulation.advance(1e30);
}

std::vector<double> numbers(const SetStep& set)
{
  const StepSetter& s = set.setter;
  return {static_cast<double>(set.step),
          set.time,
          set.size,
          static_cast<double>(s.particle),
          static_cast<double>(s.material),
          s.position[0],
          s.position[1],
          s.bound,
          s.volume_ratio,
          s.pressure,
          s.wave_speed};
}

}  // namespace

TEST_CASE("a step is set by a particle of the stiffer block, which is told as it is when the step begins")
{
  const Scene scene = two_blocks(true);
  const auto simulation = Simulation::make(scene, 1);
  advance_by(*simulation, 10);
  const double bound = simulation->stable_step();
  const std::vector<Particle> particles = particles_of(*simulation);

  simulation->advance(1e30);

  const SetStep& last = simulation->step_records().last;
  CHECK(last.step == 11);
  CHECK(last.time == simulation->time());
  CHECK(last.size == scene.time.multiplier * bound);
  CHECK(last.size == simulation->last_step_size());
  CHECK(last.setter.bound == bound);
  CHECK(last.setter.material == 1);
  const auto named =
      std::find_if(particles.begin(), particles.end(), [&](const Particle& p) { return p.id == last.setter.particle; });
  REQUIRE(named != particles.end());
  CHECK(named->material == 1);
  CHECK(last.setter.volume_ratio == Approx(named->volume_ratio));
  CHECK(last.setter.pressure == Approx(-(named->stress[0] + named->stress[1] + named->stress[2]) / 3));
  CHECK(last.setter.wave_speed == Approx(std::sqrt(uniaxial_modulus(1e8, 0.3) / 1000)).epsilon(1e-3));
  // It moves by less than that in a step.
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(last.setter.position[k] == Approx(named->position[static_cast<Eigen::Index>(k)]).margin(1e-4));
  }
}

TEST_CASE("the first, the shortest and the last step that particles set are kept, and how many each material set")
{
  const auto simulation = Simulation::make(two_blocks(true), 1);
  simulation->advance(1e30);
  std::vector<double> sizes;
  for (int n = 0; n < 20; ++n) {
    simulation->advance(1e30);
    sizes.push_back(simulation->last_step_size());
  }

  const StepRecords& records = simulation->step_records();

  // Before the first one no particle has been asked.
  CHECK(records.count(StepCause::start) == 1);
  CHECK(records.count(StepCause::particle) == 20);
  CHECK(records.by_material[0] == 0);
  CHECK(records.by_material[1] == 20);
  CHECK(records.first.step == 2);
  CHECK(records.first.size == sizes.front());
  const auto shortest = std::min_element(sizes.begin(), sizes.end());
  CHECK(records.shortest.size == *shortest);
  CHECK(records.shortest.step == 2 + (shortest - sizes.begin()));
  CHECK(records.last.step == 21);
  CHECK(records.last.size == sizes.back());
}

TEST_CASE("of particles with the same bound that with the lowest id sets the step")
{
  Scene scene = two_blocks(false);
  // By this rule all particles of a block at rest have one bound.
  scene.time.rule = StepRule::published;
  const auto simulation = Simulation::make(scene, 2);
  const std::int64_t lowest = particles_of_material(particles_of(*simulation), 1).front().id;

  advance_by(*simulation, 5);

  const StepRecords& records = simulation->step_records();
  CHECK(records.first.setter.particle == lowest);
  CHECK(records.last.setter.particle == lowest);
  CHECK(records.last.step == 5);
}

TEST_CASE("the same particles set the steps on any ranks and threads", "[ranks]")
{
  const Scene scene = two_blocks(GENERATE(true, false));
  const int n_threads = GENERATE(1, 2);
  const auto alone = Simulation::make(scene, 1);
  advance_by(*alone, 30);
  const StepRecords& expected = alone->step_records();
  REQUIRE(expected.by_material[1] == 29);

  const auto simulation = Simulation::make(scene, std::make_shared<runtime::Executor>(n_threads, on_shared_cores()),
                                           runtime::Communicator::world());
  simulation->engine().balance_every(5);
  advance_by(*simulation, 30);

  const StepRecords& records = simulation->step_records();
  CHECK(numbers(records.first) == numbers(expected.first));
  CHECK(numbers(records.shortest) == numbers(expected.shortest));
  CHECK(numbers(records.last) == numbers(expected.last));
  CHECK(records.by_material == expected.by_material);
  CHECK(records.by_cause == expected.by_cause);
}

TEST_CASE("a step that the scene's longest one cuts names no particle")
{
  Scene scene = two_blocks(true);
  scene.time.maximum_step = 1e-6;
  const auto simulation = Simulation::make(scene, 1);

  advance_by(*simulation, 5);

  const StepRecords& records = simulation->step_records();
  CHECK(records.count(StepCause::maximum_step) == 5);
  CHECK(records.count(StepCause::particle) == 0);
  CHECK(records.first.step == 0);
  CHECK(records.last.step == 0);
}

TEST_CASE("a step that the end of the time cuts names no particle")
{
  const auto simulation = Simulation::make(two_blocks(true), 1);
  advance_by(*simulation, 3);

  simulation->advance(simulation->time() + 0.3 * simulation->last_step_size());

  const StepRecords& records = simulation->step_records();
  CHECK(records.count(StepCause::end) == 1);
  CHECK(records.count(StepCause::particle) == 2);
  CHECK(records.last.step == 3);
}

TEST_CASE("a step that a rigid body on its way through a cell bounds names no particle")
{
  Scene scene = empty_scene(2, {24, 12, 1}, 0.1);
  add_box(scene, add_elastic(scene, 7800, 2e11, 0.3), {0.3, 0.3, 0}, {0.6, 0.6, 0}, {10, 0, 0}).rigid = true;
  // Its waves are slower.
  add_box(scene, add_elastic(scene, 1000, 100, 0.3), {1.6, 0.6, 0}, {2.0, 0.9, 0});
  const auto simulation = Simulation::make(scene, 1);

  advance_by(*simulation, 3);

  const StepRecords& records = simulation->step_records();
  CHECK(records.count(StepCause::start) == 1);
  CHECK(records.count(StepCause::bodies) == 2);
  CHECK(records.count(StepCause::particle) == 0);
  CHECK(records.last.step == 0);
}

}  // namespace test_step_records
