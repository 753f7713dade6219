#include <catch2/catch.hpp>

#include "tests/runtime/shared_cores.hpp"
#include "tests/tasks/scenes.hpp"

namespace test_field_copy
{

using namespace tamp;
using namespace tamp::test;

namespace
{

/// Two disks that glance off each other, on patches of which some hold nothing.
Scene glancing_disks()
{
  Scene scene = empty_scene(2, {24, 18, 1}, 0.1);
  scene.n_patches = {3, 3, 1};
  const int soft = add_elastic(scene, 1000, 1e6, 0.3), hard = add_elastic(scene, 2000, 4e6, 0.2);
  add_disk(scene, soft, 0.7, 0.8, 0.4, {6, 0.5, 0});
  add_disk(scene, hard, 1.7, 1.0, 0.4, {-6, -0.5, 0});
  return scene;
}

using Numbers = std::vector<std::pair<std::string, std::vector<double>>>;

void add(const std::vector<runtime::Column>& columns, Numbers& all)
{
  for (const runtime::Column& column : columns) {
    std::visit(
        [&](const auto& values) { all.emplace_back(column.name, std::vector<double>(values.begin(), values.end())); },
        column.values);
  }
}

/// All that a copy holds, by name.
Numbers numbers_of(const runtime::FieldCopy& copy)
{
  Numbers all;
  for (const runtime::ParticleBlock& block : copy.particles) {
    all.emplace_back(block.name, std::vector{static_cast<double>(block.n)});
    add(block.columns, all);
  }
  if (copy.nodes) add(copy.nodes->columns, all);
  return all;
}

}  // namespace

TEST_CASE("fields that are gathered from ranks are those of one process", "[ranks]")
{
  const auto world = runtime::Communicator::world();
  const auto alone = Simulation::make(glancing_disks(), 1);
  const auto together =
      Simulation::make(glancing_disks(), std::make_shared<runtime::Executor>(2, on_shared_cores()), world);
  for (int step = 0; step < 20; ++step) {
    alone->advance(1);
    together->advance(1);
  }

  const runtime::FieldCopy own = alone->fields({}, true);
  const runtime::FieldCopy all = gathered(together->fields({}, true), together->engine().graph().layout(), world);

  if (world.is_first()) {
    const Numbers numbers = numbers_of(all);
    CHECK(numbers == numbers_of(own));
    CHECK(numbers.size() == 2 * (1 + 10) + 2);
    CHECK(all.nodes->boxes == own.nodes->boxes);
  } else {
    CHECK(all.particles.empty());
  }
}

TEST_CASE("a copy of fields stays as it is while the simulation goes on")
{
  const auto simulation = Simulation::make(glancing_disks(), 1);
  simulation->advance(1);
  const runtime::FieldCopy copy = simulation->fields({}, true);
  const Numbers then = numbers_of(copy);

  for (int step = 0; step < 10; ++step) simulation->advance(1);

  CHECK(numbers_of(copy) == then);
  CHECK(numbers_of(simulation->fields({}, true)) != then);
}

}  // namespace test_field_copy
